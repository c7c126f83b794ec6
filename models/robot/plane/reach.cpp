#include "models/robot/plane/reach.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include <fmt/ranges.h>

#include "models/robot/plane/nothing_free.h"
#include "models/robot/plane/solver.h"
#include "pipeline/core/check.h"

namespace hbr::inline robots {
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

// Ends the descent once the tip is within `enough` metres.
class Arrived final : public ceres::IterationCallback {
 public:
  explicit Arrived(double enough) : cost_(enough * enough / 2) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    return summary.cost < cost_ ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

 private:
  double cost_;
};

}  // namespace

Reach::Reach(const Body& body, int tip, const Clearance& clearance, int samples, double margin, Seed seed)
    : body_(body), tip_(tip), clearance_(clearance), lower_(body.lower()), upper_(body.upper()) {
  const Eigen::Index dof = body.dof();
  const Eigen::VectorXd kept = margin * (upper_ - lower_);
  lower_ += kept;
  upper_ -= kept;
  Rng rng(seed);
  for (int i = 0; i < samples; ++i) {
    for (Eigen::Index k = 0; k < dof; ++k)
      joints_.push_back(lower_[k] + (upper_[k] - lower_[k]) * rng.uniform_double());
    const auto drawn = static_cast<int>(joints_.size() / dof) - 1;
    const Directions free = clearance.free(joints_.data() + drawn * dof);
    for (int k = 0; k < kDirections; ++k)
      if (free[k]) facing_[k].push_back(drawn);
    if (free.none()) joints_.resize(drawn * dof);
  }
  tips_.resize(joints_.size() / dof);
  if (tips_.empty()) throw nothing_free(body, clearance, tip, samples);
  all_.resize(tips_.size());
  std::iota(all_.begin(), all_.end(), 0);
  body.positions(tip, static_cast<Eigen::Index>(tips_.size()), joints_.data(), tips_.data());
}

std::vector<int> Reach::closest(const std::vector<int>& samples, const Eigen::Vector3d& target,
                                int count) const {
  std::vector<std::pair<double, int>> order;
  for (const int i : samples) order.emplace_back((tips_[i] - target).squaredNorm(), i);
  const auto end = order.begin() + std::min<std::ptrdiff_t>(count, std::ssize(order));
  std::partial_sort(order.begin(), end, order.end());
  std::vector<int> result;
  for (auto i = order.begin(); i != end; ++i) result.push_back(i->second);
  return result;
}

std::optional<Reach::Nearest> Reach::continued(const Eigen::Vector3d& target, const Board& board,
                                               const Eigen::VectorXd& before, double enough) const {
  const Eigen::VectorXd joints = descend(target, before, enough);
  if (!clearance_.clear(joints.data(), board)) return std::nullopt;
  return Nearest{joints, target - body_.position(tip_, joints.data())};
}

Reach::Nearest Reach::nearest(const Eigen::Vector3d& target, const Board& board, int starts,
                              double enough) const {
  const std::vector<int>& facing = facing_[nearest_direction(board.plane.normal())];
  Nearest best;
  double least = std::numeric_limits<double>::infinity();
  const auto offer = [&](const Eigen::VectorXd& joints) {
    const Eigen::Vector3d gap = target - body_.position(tip_, joints.data());
    if (gap.norm() >= least || !clearance_.clear(joints.data(), board)) return;
    least = gap.norm();
    best = {joints, gap};
  };
  std::vector<int> tried;
  for (const auto* samples : {&facing, &all_}) {
    if (least <= enough) break;
    for (const int start : closest(*samples, target, starts)) {
      if (least <= enough || std::ranges::count(tried, start) > 0) continue;
      tried.push_back(start);
      offer(sample(start));
      offer(descend(target, sample(start), enough));
    }
  }
  if (best.joints.size() == 0) {
    const int start = closest(facing.empty() ? all_ : facing, target, 1)[0];
    best = {sample(start), target - tips_[start]};
  }
  return best;
}

Reach::Nearest Reach::nearest_of_any(const Eigen::Vector3d& target, int starts, double enough) const {
  Nearest best{{}, Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity())};
  for (const int start : closest(all_, target, starts)) {
    const Eigen::VectorXd joints = descend(target, sample(start), enough);
    const Eigen::Vector3d gap = target - body_.position(tip_, joints.data());
    if (gap.norm() < best.gap.norm()) best = {joints, gap};
    if (best.gap.norm() <= enough) break;
  }
  return best;
}

Eigen::VectorXd Reach::descend(const Eigen::Vector3d& target, Eigen::VectorXd joints, double enough) const {
  const Eigen::Index dof = body_.dof();
  ceres::Problem problem;
  problem.AddResidualBlock(new TipError(body_, tip_, target), nullptr, joints.data());
  for (int k = 0; k < static_cast<int>(dof); ++k) {
    problem.SetParameterLowerBound(joints.data(), k, lower_[k]);
    problem.SetParameterUpperBound(joints.data(), k, upper_[k]);
  }
  ceres::Solver::Options options = dense_solver(30, 1e-9);
  options.gradient_tolerance = 1e-12;
  options.parameter_tolerance = 1e-9;
  Arrived arrived(enough);
  options.callbacks.push_back(&arrived);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return joints;
}

}  // namespace hbr::inline robots
