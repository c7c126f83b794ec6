#include "models/simbody/reach.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <numeric>

#include <fmt/ranges.h>

#include "pipeline/core/check.h"

namespace hbr {
namespace {

// Residuals [3]: from the target to the tip, in metres.
class TipError final : public ceres::CostFunction {
 public:
  TipError(const Body& body, int tip, const Eigen::Vector3d& target)
      : body_(body), tip_(tip), target_(target) {
    set_num_residuals(3);
    mutable_parameter_block_sizes()->push_back(static_cast<int>(body.dof()));
  }
  bool Evaluate(const double* const* joints, double* residuals, double** jacobians) const override {
    Eigen::Matrix3Xd slopes;
    const bool wanted = jacobians && jacobians[0];
    Eigen::Map<Eigen::Vector3d> error(residuals);
    error = body_.position(tip_, joints[0], wanted ? &slopes : nullptr) - target_;
    if (wanted) {
      using RowMajor = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor>;
      Eigen::Map<RowMajor> out(jacobians[0], 3, slopes.cols());
      out = slopes;
    }
    return true;
  }

 private:
  const Body& body_;
  int tip_;
  Eigen::Vector3d target_;
};

}  // namespace

Reach::Reach(const Body& body, int tip, const SelfCollision& collision, int samples, double margin, Seed seed)
    : body_(body), tip_(tip), collision_(collision), lower_(body.lower()), upper_(body.upper()) {
  const Eigen::Index dof = body.dof();
  const Eigen::VectorXd kept = margin * (upper_ - lower_);
  lower_ += kept;
  upper_ -= kept;
  Rng rng(seed);
  for (int i = 0; i < samples; ++i) {
    for (Eigen::Index k = 0; k < dof; ++k)
      joints_.push_back(lower_[k] + (upper_[k] - lower_[k]) * rng.uniform_double());
    if (collision.collides(joints_.data() + joints_.size() - dof)) joints_.resize(joints_.size() - dof);
  }
  tips_.resize(joints_.size() / dof);
  if (tips_.empty())
    throw InputError("{}: each of {} configurations of {} runs the robot into itself; expected free ones",
                     body.model().path.string(), samples, fmt::join(body.moving(), ", "));
  body.positions(tip, static_cast<Eigen::Index>(tips_.size()), joints_.data(), tips_.data());
}

Reach::Nearest Reach::nearest(const Eigen::Vector3d& target, int starts, double enough) const {
  const Eigen::Index dof = body_.dof();
  std::vector<double> distances(tips_.size());
  for (std::size_t i = 0; i < tips_.size(); ++i) distances[i] = (tips_[i] - target).squaredNorm();
  std::vector<int> order(tips_.size());
  std::iota(order.begin(), order.end(), 0);
  starts = std::min<int>(starts, static_cast<int>(order.size()));
  std::partial_sort(order.begin(), order.begin() + starts, order.end(), [&](int a, int b) {
    return distances[a] != distances[b] ? distances[a] < distances[b] : a < b;
  });

  ceres::Solver::Options options;
  options.max_num_iterations = 30;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.function_tolerance = 1e-9;
  options.gradient_tolerance = 1e-12;
  options.parameter_tolerance = 1e-9;
  const double* nearest = joints_.data() + order[0] * dof;
  Nearest best{Eigen::Map<const Eigen::VectorXd>(nearest, dof), target - tips_[order[0]]};
  double best_distance = best.gap.norm();
  for (int s = 0; s < starts && best_distance > enough; ++s) {
    const auto start = joints_.begin() + order[s] * dof;
    Eigen::VectorXd joints(dof);
    std::copy(start, start + dof, joints.begin());
    ceres::Problem problem;
    problem.AddResidualBlock(new TipError(body_, tip_, target), nullptr, joints.data());
    for (Eigen::Index k = 0; k < dof; ++k) {
      problem.SetParameterLowerBound(joints.data(), static_cast<int>(k), lower_[k]);
      problem.SetParameterUpperBound(joints.data(), static_cast<int>(k), upper_[k]);
    }
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    const Eigen::Vector3d gap = target - body_.position(tip_, joints.data());
    if (gap.norm() < best_distance && !collision_.collides(joints.data())) {
      best_distance = gap.norm();
      best = {joints, gap};
    }
  }
  return best;
}

}  // namespace hbr
