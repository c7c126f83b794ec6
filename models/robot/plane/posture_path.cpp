#include "models/robot/plane/posture_path.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "models/robot/plane/solver.h"

namespace hbr::inline robots {
namespace {

constexpr int kNear = 64;             // elites from which a place's inverse solutions start
constexpr std::size_t kCarried = 32;  // candidates of the place before, those of the shortest ways
constexpr double kSame = 0.01;        // rad: candidates as near to each other as this are one
constexpr double kDamping = 1e-6;     // m^2/rad^2: of inverse kinematics, against singular postures
// m: a pen so far off costs as much as a turn of 1 rad; first little, so that large turns find their way.
constexpr std::array kUnits = {1e-2, 1e-3, 1e-4};
constexpr int kRounds = 8;  // of straightening, each with more places kept as they were

struct Candidate {
  Eigen::VectorXd joints;
  double jumps = 0;  // rad^2, from the start: squares of the distances between configurations
  int from = -1;     // among the candidates of the place before
};
using Candidates = std::vector<Candidate>;

double distance_to(const RobotOnPlane& robot, const Eigen::Vector3d& target, const double* joints) {
  return (robot.body().position(robot.tip(), joints) - target).norm();
}

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

class PosturePath {
 public:
  PosturePath(const RobotOnPlane& robot, const PointLayer& points, const Trace& trace)
      : robot_(robot), points_(points), trace_(trace), enough_(robot.off_plane_tolerance() / 10) {
    for (Eigen::Index k = 0; k < trace.points(); ++k) targets_.push_back(robot.plane().to_robot(pen(k)));
  }

  std::vector<double> smoothest() const {
    std::vector<Candidates> places;
    for (Eigen::Index k = 0; k < trace_.points(); ++k) {
      Candidates found = candidates(k, places.empty() ? Candidates() : places.back());
      if (k > 0)
        for (Candidate& to : found) connect(places.back(), to);
      std::ranges::stable_sort(found, {}, &Candidate::jumps);
      places.push_back(std::move(found));
    }
    std::vector<Eigen::VectorXd> way;
    int at = 0;  // the first of the last place has the best way
    for (auto place = places.rbegin(); place != places.rend(); ++place) {
      way.push_back((*place)[at].joints);
      at = (*place)[at].from;
    }
    std::ranges::reverse(way);
    const std::vector<double> found = row_by_row(straightened_where_possible(std::move(way)));
    return joint_travel(found, robot_.dof()) <= joint_travel(trace_.joints, robot_.dof()) ? found
                                                                                          : trace_.joints;
  }

 private:
  Eigen::Vector2d pen(Eigen::Index k) const { return {trace_.pen[2 * k], trace_.pen[2 * k + 1]}; }
  Eigen::VectorXd own(Eigen::Index k) const {
    return Eigen::Map<const Eigen::VectorXd>(&trace_.joints[k * robot_.dof()], robot_.dof());
  }
  std::vector<double> row_by_row(const std::vector<Eigen::VectorXd>& way) const {
    std::vector<double> joints;
    for (const Eigen::VectorXd& q : way) joints.insert(joints.end(), q.begin(), q.end());
    return joints;
  }

  Candidates candidates(Eigen::Index k, const Candidates& before) const {
    Candidates found{{own(k)}};
    const auto add = [&](const Eigen::VectorXd& start) {
      const Eigen::VectorXd joints = inverse(start, targets_[k]);
      for (const Candidate& other : found)
        if ((other.joints - joints).norm() < kSame) return;
      if (possible(joints, k)) found.push_back({joints});
    };
    for (std::size_t i = 0; i < std::min(kCarried, before.size()); ++i) add(before[i].joints);
    for (const std::int32_t elite : elites_near(pen(k)))
      add(Eigen::Map<const Eigen::VectorXd>(points_.joints(elite), robot_.dof()));
    return found;
  }

  std::vector<std::int32_t> elites_near(const Eigen::Vector2d& place) const {
    std::vector<std::pair<double, std::int32_t>> all(points_.size());
    for (std::int32_t i = 0; i < points_.size(); ++i)
      all[i] = {(points_.position(i) - place).squaredNorm(), i};
    const std::size_t n = std::min<std::size_t>(kNear, all.size());
    std::ranges::partial_sort(all, all.begin() + static_cast<std::ptrdiff_t>(n));
    std::vector<std::int32_t> near;
    for (std::size_t i = 0; i < n; ++i) near.push_back(all[i].second);
    return near;
  }

  // Damped least squares from `joints` on; a joint that stands at its limit leaves the work to the others.
  Eigen::VectorXd inverse(Eigen::VectorXd joints, const Eigen::Vector3d& target) const {
    Eigen::Matrix3Xd slopes;
    for (int i = 0; i < 20; ++i) {
      const Eigen::Vector3d off = target - robot_.body().position(robot_.tip(), joints.data(), &slopes);
      if (off.norm() <= enough_ / 10) break;
      Eigen::VectorXd step;
      for (bool blocked = true; blocked;) {
        const Eigen::Matrix3d square = slopes * slopes.transpose() + kDamping * Eigen::Matrix3d::Identity();
        step = slopes.transpose() * square.ldlt().solve(off);
        blocked = false;
        for (Eigen::Index k = 0; k < joints.size(); ++k) {
          const bool at_limit = step[k] > 0 ? joints[k] >= robot_.upper()[k] : joints[k] <= robot_.lower()[k];
          if (step[k] == 0 || !at_limit) continue;
          slopes.col(k).setZero();
          blocked = true;
        }
      }
      joints = (joints + step).cwiseMax(robot_.lower()).cwiseMin(robot_.upper());
    }
    return joints;
  }

  bool possible(const Eigen::VectorXd& joints, Eigen::Index k) const {
    return distance_to(robot_, targets_[k], joints.data()) <= enough_ &&
           robot_.clear(joints.data(), points_.frame().half_side);
  }

  static void connect(const Candidates& before, Candidate& to) {
    to.jumps = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < before.size(); ++i) {
      const double jumps = before[i].jumps + (to.joints - before[i].joints).squaredNorm();
      if (jumps >= to.jumps) continue;
      to.jumps = jumps;
      to.from = static_cast<int>(i);
    }
  }

  // Places where the straightened way can't be had keep what they have, and the others are straightened
  // again.
  std::vector<Eigen::VectorXd> straightened_where_possible(const std::vector<Eigen::VectorXd>& way) const {
    std::vector<bool> kept(way.size(), false);
    for (int round = 0; round < kRounds; ++round) {
      std::vector<Eigen::VectorXd> straight = straightened(way, kept);
      bool all = true;
      for (std::size_t k = 0; k < way.size(); ++k) {
        if (kept[k] || possible(straight[k], static_cast<Eigen::Index>(k))) continue;
        kept[k] = true;
        all = false;
      }
      if (all) return straight;
    }
    return way;
  }

  std::vector<Eigen::VectorXd> straightened(std::vector<Eigen::VectorXd> way,
                                            const std::vector<bool>& kept) const {
    const int dof = static_cast<int>(robot_.dof());
    for (const double unit : kUnits) {
      ceres::Problem problem;
      for (std::size_t k = 0; k < way.size(); ++k) {
        problem.AddResidualBlock(new PlaceCost(robot_, targets_[k], unit), nullptr, way[k].data());
        if (k > 0) problem.AddResidualBlock(new TurnCost(dof), nullptr, way[k - 1].data(), way[k].data());
        for (int i = 0; i < dof; ++i) {
          problem.SetParameterLowerBound(way[k].data(), i, robot_.lower()[i]);
          problem.SetParameterUpperBound(way[k].data(), i, robot_.upper()[i]);
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

  const RobotOnPlane& robot_;
  const PointLayer& points_;
  const Trace& trace_;
  double enough_;  // m
  std::vector<Eigen::Vector3d> targets_;
};

}  // namespace

double joint_travel(const std::vector<double>& joints, Eigen::Index dof) {
  double travel = 0;
  for (std::size_t at = static_cast<std::size_t>(dof); at < joints.size(); at += dof) {
    const Eigen::Map<const Eigen::VectorXd> before(&joints[at - dof], dof), after(&joints[at], dof);
    travel += (after - before).norm();
  }
  return travel;
}

std::vector<double> least_travel(const RobotOnPlane& robot, const PointLayer& points, const Trace& trace) {
  return trace.points() < 2 ? trace.joints : PosturePath(robot, points, trace).smoothest();
}

}  // namespace hbr::inline robots
