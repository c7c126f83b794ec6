#include "models/robot/plane/project_onto_plane.h"

#include <cmath>

#include "models/robot/plane/solver.h"

namespace hbr::inline robots {
namespace {

constexpr double kUnit = 1e-4;  // m

class ProjectionCost final : public ceres::CostFunction {
 public:
  ProjectionCost(const RobotOnPlane& robot, const Eigen::Vector3d& target) : robot_(robot), target_(target) {
    const int dof = static_cast<int>(robot.dof());
    set_num_residuals(3 + dof);
    mutable_parameter_block_sizes()->push_back(dof);
  }
  bool Evaluate(const double* const* joints, double* residuals, double** jacobians) const override {
    const bool wanted = jacobians && jacobians[0];
    Eigen::MatrixXd slopes;
    const Eigen::VectorXd all = projection_residuals(robot_, target_, joints[0], wanted ? &slopes : nullptr);
    Eigen::Map<Eigen::VectorXd>(residuals, all.size()) = all;
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    if (wanted) Eigen::Map<RowMajor>(jacobians[0], slopes.rows(), slopes.cols()) = slopes;
    return true;
  }

 private:
  const RobotOnPlane& robot_;
  Eigen::Vector3d target_;
};

}  // namespace

Eigen::VectorXd projection_residuals(const RobotOnPlane& robot, const Eigen::Vector3d& target,
                                     const double* joints, Eigen::MatrixXd* jacobian) {
  const Eigen::Index dof = robot.dof();
  // A copy: a sum over memory of others would be taken in an order that depends on where it begins.
  const Eigen::VectorXd q = Eigen::Map<const Eigen::VectorXd>(joints, dof);
  const double share = 1 / std::sqrt(static_cast<double>(dof));  // the squares sum to the variance
  Eigen::Matrix3Xd slopes;
  Eigen::VectorXd residuals(3 + dof);
  residuals.head<3>() =
      (robot.body().position(robot.tip(), joints, jacobian ? &slopes : nullptr) - target) / kUnit;
  residuals.tail(dof) = share * (q.array() - q.mean());
  if (jacobian) {
    jacobian->resize(3 + dof, dof);
    jacobian->topRows<3>() = slopes / kUnit;
    jacobian->bottomRows(dof) =
        share * (Eigen::MatrixXd::Identity(dof, dof).array() - 1 / static_cast<double>(dof)).matrix();
  }
  return residuals;
}

Eigen::VectorXd project_onto_plane(const RobotOnPlane& robot, const Eigen::Vector3d& target,
                                   const Eigen::VectorXd& start) {
  Eigen::VectorXd joints = start;
  ceres::Problem problem;
  problem.AddResidualBlock(new ProjectionCost(robot, target), nullptr, joints.data());
  for (int k = 0; k < static_cast<int>(joints.size()); ++k) {
    problem.SetParameterLowerBound(joints.data(), k, robot.lower()[k]);
    problem.SetParameterUpperBound(joints.data(), k, robot.upper()[k]);
  }
  ceres::Solver::Summary summary;
  ceres::Solve(dense_solver(30, 1e-9), &problem, &summary);
  const auto distance = [&](const Eigen::VectorXd& q) {
    return (robot.body().position(robot.tip(), q.data()) - target).norm();
  };
  return distance(joints) <= distance(start) ? joints : start;
}

}  // namespace hbr::inline robots
