// Points, lines and arcs at random, and what becomes of a request by their arrays alone.
#pragma once

#include <numbers>

#include "models/arm/planar_arm.h"
#include "pipeline/hierarchy/layers/arcs.h"
#include "pipeline/hierarchy/layers/lines.h"
#include "pipeline/hierarchy/layers/points.h"
#include "pipeline/hierarchy/stack.h"
#include "stages/studies/layer_errors.h"

namespace hbr {

inline constexpr double kHalfSide = 0.64, kLongestLine = 0.25;
inline const Frame kFrame{kHalfSide, kLongestLine};
inline const PlanarArm kArm({.1, .2, .28}, std::numbers::pi / 2);
inline Elites random_elites(int n, int genes, int descriptor_size, Rng& rng) {
  Elites elites;
  elites.solution = Rows::NullaryExpr(n, genes, [&] { return rng.uniform(); });
  elites.measures = Rows::NullaryExpr(n, descriptor_size, [&] { return rng.uniform(); });
  elites.objective.setZero(n);
  for (int i = 0; i < n; ++i) {
    elites.id.push_back(i);
    elites.parent.push_back(-1);
  }
  return elites;
}

inline int nearest(const Rows& rows, const Eigen::VectorXd& to) {
  Eigen::Index best = 0;
  (rows.cast<double>().rowwise() - to.transpose()).rowwise().squaredNorm().minCoeff(&best);
  return static_cast<int>(best);
}

struct Hierarchy {
  Elites points, lines, arcs;
  Stack stack;

  Hierarchy(int n, Seed seed) {
    Rng rng(seed);
    points = random_elites(n, 3, 2, rng);
    for (int i = 0; i < n; ++i) {
      double joints[3];
      decode_joints(kArm, points.solution.row(i).data(), joints);
      Pen pen;
      kArm.pens(1, joints, &pen);
      points.measures.row(i) = kFrame.point_descriptor(pen.position).cast<float>().transpose();
    }
    lines = random_elites(50, 2, 2, rng);
    arcs = random_elites(40, 3, 3, rng);
    stack.add(make_points({kHalfSide, "joint_variance"}, {kArm}), points);
    stack.add(make_lines({{kLongestLine, "disc"}, 10}, {kArm, &stack}), lines);
    stack.add(make_arcs({{"circle", "mean"}, "turn", 10}, {kArm, &stack}), arcs);
  }
  Side side(int level) const { return {stack.points(), stack.layer(level)}; }

  Eigen::Vector2d position(int elite) const {
    return kFrame.point(points.measures.row(elite).transpose().cast<double>());
  }
  int start_at(const Eigen::Vector2d& place) const {
    return nearest(points.measures, kFrame.point_descriptor(place));
  }
  void draw_line(const Eigen::Vector2d& descriptor, std::vector<Eigen::Vector2d>& path) const {
    const int line = nearest(lines.measures, descriptor);
    path.push_back(position(start_at(path.back() + decode_line(kFrame, lines.solution.row(line).data()))));
  }
  std::vector<Eigen::Vector2d> line(int start, const Rows& command) const {
    std::vector<Eigen::Vector2d> path{position(start)};
    draw_line(command.row(0).transpose().cast<double>(), path);
    return path;
  }
  std::vector<Eigen::Vector2d> arc(int start, const Rows& command) const {
    std::vector<Eigen::Vector2d> path{position(start)};
    const int arc = nearest(arcs.measures, command.row(0).transpose().cast<double>());
    for (const Eigen::Vector2d& wanted : arc_controllers()[1].decode(kFrame, arcs.solution.row(arc).data()))
      draw_line(kFrame.line_descriptor(wanted), path);
    return path;
  }
};

}  // namespace hbr
