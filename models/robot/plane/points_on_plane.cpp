#include "models/robot/plane/points_on_plane.h"

#include <cmath>

#include "models/robot/plane/project_onto_plane.h"
#include "pipeline/hierarchy/joints.h"

namespace hbr::inline robots {
namespace {

Eigen::VectorXd joints_of(const RobotOnPlane& robot, const Elites& elites, Eigen::Index row) {
  Eigen::VectorXd joints(robot.dof());
  decode_joints(robot, elites.solution.row(row).data(), joints.data());
  return joints;
}

}  // namespace

Eigen::Vector3d place_of(const RobotOnPlane& robot, const Frame& frame, const Elites& elites,
                         Eigen::Index row) {
  return robot.plane().to_robot(frame.point(elites.measures.row(row).transpose().cast<double>()));
}

Eigen::VectorXd perform_point(const RobotOnPlane& robot, const Frame& frame, Elites& elites,
                              Eigen::Index row) {
  const Eigen::VectorXd joints = joints_of(robot, elites, row);
  Pen pen;
  robot.pens(1, joints.data(), &pen);
  elites.measures.row(row) =
      frame.point_descriptor(pen.position).array().max(0).min(1).cast<float>().transpose();
  elites.objective[row] = static_cast<float>(-joint_variance(joints.data(), robot.dof()));
  return joints;
}

Eigen::VectorXd project_point(const RobotOnPlane& robot, const Frame& frame, Elites& elites,
                              Eigen::Index row) {
  const Eigen::VectorXf genes = encode_joints(
      robot, project_onto_plane(robot, place_of(robot, frame, elites, row), joints_of(robot, elites, row)));
  Eigen::VectorXd joints(robot.dof());
  decode_joints(robot, genes.data(), joints.data());
  if (robot.clear(joints.data(), frame.half_side)) elites.solution.row(row) = genes.transpose();
  return perform_point(robot, frame, elites, row);
}

PointErrors point_errors(const RobotOnPlane& robot, const Eigen::Vector3d& place,
                         const Eigen::VectorXd& joints) {
  const Eigen::Vector3d tip = robot.body().position(robot.tip(), joints.data());
  return {std::abs(robot.plane().to_pen(tip).off_plane), (tip - place).norm(),
          joint_variance(joints.data(), robot.dof())};
}

}  // namespace hbr::inline robots
