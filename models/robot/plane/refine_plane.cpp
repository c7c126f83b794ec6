#include "models/robot/plane/refine_plane.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "models/robot/plane/solver.h"

namespace hbr::inline robots {
namespace {

// Origin, azimuth, elevation, logarithm of the scale.
using Pose = Eigen::Matrix<double, 6, 1>;
// Of the drawing's radius, root mean square: as bad as a start left by its looseness.
constexpr double kMissed = 1. / 3000;
constexpr double kMoved = 1. / 8, kTurned = 0.1, kScaled = 0.005;  // of the radius; rad; of the scale

constexpr double kArrived = 1e-5;                       // m, from the tip to a point
constexpr double kLeaned = 5 * std::numbers::pi / 180;  // the most that the elevation changes

// An angle inside a range, as a function of a number without bounds: bounds would make the solver timid.
class BoundAngle {
 public:
  BoundAngle(double lower, double upper) : middle_((lower + upper) / 2), half_(0.999 * (upper - lower) / 2) {}
  double at(double free) const { return middle_ + half_ * std::tanh(free); }
  double slope(double free) const { return half_ * (1 - std::pow(std::tanh(free), 2)); }
  double free(double angle) const { return std::atanh(std::clamp((angle - middle_) / half_, -0.98, 0.98)); }

 private:
  double middle_, half_;
};

Pose pose_of(const DrawingPlane& plane) {
  // Of u, which is level, so that the azimuth is there also for a plane that is seen from above.
  const double azimuth = std::atan2(plane.u[0], -plane.u[1]),
               elevation = -std::asin(std::clamp(plane.normal()[2], -1., 1.));
  Pose pose;
  pose << plane.origin, azimuth, elevation, std::log(plane.scale);
  return pose;
}

DrawingPlane plane_of(const Pose& pose) {
  return DrawingPlane::facing(pose.head<3>(), pose[3], pose[4], std::exp(pose[5]));
}

// One residual for each point, the distance to the tip's reach, then one for what is below the floor, then
// six for the prior.
class Missed final : public ceres::CostFunction {
 public:
  // The parameters are a pose with its elevation set free.
  Missed(const Reach& reach, const std::vector<Eigen::Vector2d>& points, const Pose& start,
         const BoundAngle& elevation, double half_side, double floor, Postures postures, Workers& workers)
      : reach_(reach),
        points_(points),
        start_(start),
        elevation_(elevation),
        half_side_(half_side),
        floor_(floor),
        postures_(std::move(postures)),
        workers_(workers) {
    postures_.resize(points.size());
    for (const Eigen::Vector2d& p : points) size_ = std::max(size_, std::exp(start[5]) * p.norm());
    loose_ << Eigen::Vector3d::Constant(kMoved * size_), kTurned, kTurned, kScaled;
    set_num_residuals(static_cast<int>(points.size()) + 7);
    mutable_parameter_block_sizes()->push_back(6);
  }

  bool Evaluate(const double* const* parameters, double* residuals, double** jacobians) const override {
    Pose pose = Eigen::Map<const Pose>(parameters[0]);
    pose[4] = elevation_.at(pose[4]);
    const Board board{plane_of(pose), half_side_};
    const std::size_t n = points_.size();
    const double unit = kMissed * size_ * std::sqrt(static_cast<double>(n));
    using Jacobian = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;
    const bool wanted = jacobians && jacobians[0];
    Eigen::Map<Jacobian> slopes(wanted ? jacobians[0] : nullptr,
                                wanted ? static_cast<Eigen::Index>(n) + 7 : 0, 6);
    workers_.for_each(n, [&](std::size_t i) {
      const Eigen::Vector3d target = board.plane.to_robot(points_[i]);
      std::optional<Reach::Nearest> found;
      if (postures_[i].size() > 0) found = reach_.continued(target, board, postures_[i], kArrived);
      if (!found) found = reach_.nearest(target, board, 3, kArrived);
      const Eigen::Vector3d& gap = found->gap;
      const double distance = gap.norm();
      postures_[i] = found->joints;
      residuals[i] = distance / unit;
      if (!wanted) return;
      // The gradient of the distance to a set is the unit vector away from it, and 0 within.
      const Eigen::Vector3d away =
          distance > kArrived ? Eigen::Vector3d(gap / distance) : Eigen::Vector3d::Zero();
      slopes.row(static_cast<Eigen::Index>(i)) = away.transpose() * moves(pose, points_[i]) / unit;
    });
    if (wanted) slopes.bottomRows<7>().setZero();
    const auto row = static_cast<Eigen::Index>(n);
    // The board's lower edge is level.
    const double half = std::exp(pose[5]) * half_side_, down = half * std::cos(pose[4]);
    const double below = std::max(0., floor_ - (pose[2] - down)) / (kMissed * size_);
    residuals[row] = below;
    if (wanted && below > 0) slopes.row(row) << 0, 0, -1, 0, -half * std::sin(pose[4]), down;
    if (wanted) slopes.row(row) /= kMissed * size_;
    for (int k = 0; k < 6; ++k) {
      residuals[row + 1 + k] = (pose[k] - start_[k]) / loose_[k];
      if (wanted) slopes(row + 1 + k, k) = 1 / loose_[k];
    }
    if (wanted) slopes.col(4) *= elevation_.slope(parameters[0][4]);
    return true;
  }

 private:
  // Derivative of a target by the pose.
  static Eigen::Matrix<double, 3, 6> moves(const Pose& pose, const Eigen::Vector2d& point) {
    const double ca = std::cos(pose[3]), sa = std::sin(pose[3]), ce = std::cos(pose[4]),
                 se = std::sin(pose[4]);
    const double x = std::exp(pose[5]) * point[0], y = std::exp(pose[5]) * point[1];
    Eigen::Matrix<double, 3, 6> d;
    d.leftCols<3>().setIdentity();
    d.col(3) = x * Eigen::Vector3d(ca, sa, 0) + y * Eigen::Vector3d(sa * se, -ca * se, 0);
    d.col(4) = y * Eigen::Vector3d(-ca * ce, -sa * ce, -se);
    d.col(5) = x * Eigen::Vector3d(sa, -ca, 0) + y * Eigen::Vector3d(-ca * se, -sa * se, ce);
    return d;
  }

  const Reach& reach_;
  const std::vector<Eigen::Vector2d>& points_;
  Pose start_, loose_;
  BoundAngle elevation_;
  double size_ = 0;  // m, the drawing's radius
  double half_side_, floor_;
  mutable Postures postures_;  // of each point its own, which one thread at a time changes
  Workers& workers_;
};

}  // namespace

Board refine_plane(const Board& board, const BoardRules& rules, const Reach& reach,
                   const std::vector<Eigen::Vector2d>& points, Workers& workers, Postures postures) {
  const Pose start = pose_of(board.plane);
  const auto [lowest, highest] = elevations_about(start[4]);
  const BoundAngle elevation(std::max(lowest, start[4] - kLeaned), std::min(highest, start[4] + kLeaned));
  Pose pose = start;
  pose[4] = elevation.free(start[4]);
  ceres::Problem problem;
  problem.AddResidualBlock(new Missed(reach, points, start, elevation, board.half_side, rules.floor(),
                                      std::move(postures), workers),
                           nullptr, pose.data());
  ceres::Solver::Summary summary;
  ceres::Solve(dense_solver(15, 1e-3), &problem, &summary);
  pose[4] = elevation.at(pose[4]);
  return rules.raised({plane_of(pose), board.half_side});
}

std::vector<double> distances_to_reach(const Board& board, const Reach& reach,
                                       const std::vector<Eigen::Vector2d>& points, Workers& workers,
                                       Postures* postures) {
  Postures none;
  Postures& known = postures ? *postures : none;
  known.resize(points.size());
  std::vector<double> distances(points.size());
  workers.for_each(points.size(), [&](std::size_t i) {
    const Eigen::Vector3d target = board.plane.to_robot(points[i]);
    std::optional<Reach::Nearest> found;
    if (known[i].size() > 0) found = reach.continued(target, board, known[i], kArrived);
    if (!found || found->gap.norm() > kArrived)
      if (Reach::Nearest other = reach.nearest(target, board, 8, kArrived);
          !found || other.gap.norm() < found->gap.norm())
        found = std::move(other);
    known[i] = found->joints;
    distances[i] = found->gap.norm();
  });
  return distances;
}

}  // namespace hbr::inline robots
