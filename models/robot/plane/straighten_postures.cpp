#include "models/robot/plane/straighten_postures.h"

#include <array>

#include "models/robot/plane/solver.h"

namespace hbr::inline robots {
namespace {

// m: a pen so far off costs as much as a turn of 1 rad; first little, so that large turns find their way.
constexpr std::array kUnits = {1e-2, 1e-3, 1e-4};

// The pen's distance from its place, in units.
class PlaceCost final : public ceres::CostFunction {
 public:
  PlaceCost(const RobotOnPlane& robot, const Eigen::Vector3d& target, double unit)
      : robot_(robot), target_(target), unit_(unit) {
    set_num_residuals(3);
    mutable_parameter_block_sizes()->push_back(static_cast<int>(robot.dof()));
  }
  bool Evaluate(const double* const* joints, double* residuals, double** jacobians) const override {
    const bool wanted = jacobians && jacobians[0];
    Eigen::Matrix3Xd slopes;
    Eigen::Map<Eigen::Vector3d>(residuals, 3) =
        (robot_.body().position(robot_.tip(), joints[0], wanted ? &slopes : nullptr) - target_) / unit_;
    using RowMajor = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor>;
    if (wanted) Eigen::Map<RowMajor>(jacobians[0], 3, robot_.dof()) = slopes / unit_;
    return true;
  }

 private:
  const RobotOnPlane& robot_;
  Eigen::Vector3d target_;
  double unit_;
};

// How far the joints turn from one place to the next.
class TurnCost final : public ceres::CostFunction {
 public:
  explicit TurnCost(int dof) : dof_(dof) {
    set_num_residuals(dof);
    *mutable_parameter_block_sizes() = {dof, dof};
  }
  bool Evaluate(const double* const* joints, double* residuals, double** jacobians) const override {
    for (int i = 0; i < dof_; ++i) residuals[i] = joints[1][i] - joints[0][i];
    for (int block = 0; jacobians && block < 2; ++block) {
      if (!jacobians[block]) continue;
      using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
      Eigen::Map<RowMajor>(jacobians[block], dof_, dof_) =
          (block == 0 ? -1 : 1) * Eigen::MatrixXd::Identity(dof_, dof_);
    }
    return true;
  }

 private:
  int dof_;
};

}  // namespace

std::vector<Eigen::VectorXd> straightened(const RobotOnPlane& robot,
                                          const std::vector<Eigen::Vector3d>& places,
                                          std::vector<Eigen::VectorXd> way, const std::vector<bool>& kept) {
  const int dof = static_cast<int>(robot.dof());
  // Genes become joints by a sum that may be a rounding beyond a limit, and Ceres solves nothing where a
  // constant is.
  for (std::size_t k = 0; k < way.size(); ++k)
    if (kept[k]) way[k] = way[k].cwiseMax(robot.lower()).cwiseMin(robot.upper());
  for (const double unit : kUnits) {
    ceres::Problem problem;
    for (std::size_t k = 0; k < way.size(); ++k) {
      problem.AddResidualBlock(new PlaceCost(robot, places[k], unit), nullptr, way[k].data());
      if (k > 0) problem.AddResidualBlock(new TurnCost(dof), nullptr, way[k - 1].data(), way[k].data());
      for (int i = 0; i < dof; ++i) {
        problem.SetParameterLowerBound(way[k].data(), i, robot.lower()[i]);
        problem.SetParameterUpperBound(way[k].data(), i, robot.upper()[i]);
      }
      if (kept[k]) problem.SetParameterBlockConstant(way[k].data());
    }
    ceres::Solver::Options options = dense_solver(20, 1e-4);
    options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;  // places know their neighbours alone
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
  }
  return way;
}

}  // namespace hbr::inline robots
