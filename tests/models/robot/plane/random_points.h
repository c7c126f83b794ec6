// Layers of points found at random, and traces over them.
#pragma once

#include <functional>

#include "models/robot/plane/points_on_plane.h"
#include "pipeline/core/random.h"
#include "pipeline/hierarchy/joints.h"
#include "pipeline/hierarchy/point_layer.h"
#include "pipeline/hierarchy/trace.h"
#include "tests/models/robot/plane/three_links.h"

namespace hbr {

// Random configurations, which hold the arm in all ways; those that run into the robot are left out, and
// those that are not wanted.
inline Elites random_elites(
    const RobotOnPlane& robot, int most,
    const std::function<bool(const Eigen::VectorXd&)>& wanted = [](const auto&) { return true; }) {
  Rng rng(Seed(4));
  Elites elites;
  elites.solution.resize(most, robot.dof());
  for (float& gene : elites.solution.reshaped()) gene = rng.uniform();
  elites.measures = Rows::Zero(most, 2);
  elites.objective = Eigen::VectorXf::Zero(most);
  Eigen::Index kept = 0;
  for (Eigen::Index i = 0; i < most; ++i) {
    Eigen::VectorXd joints(robot.dof());
    decode_joints(robot, elites.solution.row(i).data(), joints.data());
    if (!robot.clear(joints.data(), kFrame.half_side) || !wanted(joints)) continue;
    elites.solution.row(kept) = elites.solution.row(i).eval();
    elites.id.push_back(kept);
    elites.parent.push_back(-1);
    perform_point(robot, kFrame, elites, kept++);
  }
  elites.solution.conservativeResize(kept, robot.dof());
  elites.measures.conservativeResize(kept, 2);
  elites.objective.conservativeResize(kept);
  return elites;
}
inline PointLayer random_layer(const RobotOnPlane& robot, int most) {
  return {random_elites(robot, most), robot, kFrame};
}

// From elite to elite along a line, as layers above go.
inline Trace along(const PointLayer& layer, const Eigen::Vector2d& from, const Eigen::Vector2d& to, int n) {
  Trace trace;
  for (int k = 0; k < n; ++k) {
    const std::int32_t elite = layer.nearest(from + (to - from) * k / (n - 1));
    const Eigen::Vector2d p = layer.position(elite);
    trace.pen.insert(trace.pen.end(), {static_cast<float>(p.x()), static_cast<float>(p.y())});
    trace.joints.insert(trace.joints.end(), layer.joints(elite), layer.joints(elite) + layer.dof());
  }
  return trace;
}

}  // namespace hbr
