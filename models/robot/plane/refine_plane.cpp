#include "models/robot/plane/refine_plane.h"

#include <algorithm>
#include <cmath>

#include "models/robot/plane/solver.h"

namespace hbr {
namespace {

// Origin, azimuth, elevation, logarithm of the scale.
using Pose = Eigen::Matrix<double, 6, 1>;
// Of the drawing's radius, root mean square: as bad as a start left by its looseness.
constexpr double kMissed = 1. / 3000;
constexpr double kMoved = 1. / 8, kTurned = 0.1, kScaled = 0.005;  // of the radius; rad; of the scale

Pose pose_of(const DrawingPlane& plane) {
  // Of u, which is level, so that the azimuth is there also for a plane that is seen from above.
  const double azimuth = std::atan2(plane.u[0], -plane.u[1]), elevation = -std::asin(plane.normal()[2]);
  Pose pose;
  pose << plane.origin, azimuth, elevation, std::log(plane.scale);
  return pose;
}

DrawingPlane plane_of(const Pose& pose) {
  return DrawingPlane::facing(pose.head<3>(), pose[3], pose[4], std::exp(pose[5]));
}

// One residual for each point, the distance to the tip's reach, then six for the prior.
class Missed final : public ceres::CostFunction {
 public:
  Missed(const Reach& reach, const std::vector<Eigen::Vector2d>& points, const Pose& start, double half_side,
         Workers& workers)
      : reach_(reach), points_(points), start_(start), half_side_(half_side), workers_(workers) {
    for (const Eigen::Vector2d& p : points) size_ = std::max(size_, std::exp(start[5]) * p.norm());
    loose_ << Eigen::Vector3d::Constant(kMoved * size_), kTurned, kTurned, kScaled;
    set_num_residuals(static_cast<int>(points.size()) + 6);
    mutable_parameter_block_sizes()->push_back(6);
  }

  bool Evaluate(const double* const* parameters, double* residuals, double** jacobians) const override {
    const Pose pose = Eigen::Map<const Pose>(parameters[0]);
    const Board board{plane_of(pose), half_side_};
    const std::size_t n = points_.size();
    const double unit = kMissed * size_ * std::sqrt(static_cast<double>(n));
    using Jacobian = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;
    const bool wanted = jacobians && jacobians[0];
    Eigen::Map<Jacobian> slopes(wanted ? jacobians[0] : nullptr,
                                wanted ? static_cast<Eigen::Index>(n) + 6 : 0, 6);
    workers_.for_each(n, [&](std::size_t i) {
      const Eigen::Vector3d target = board.plane.to_robot(points_[i]);
      const Eigen::Vector3d gap = reach_.nearest(target, board, 3, 1e-5).gap;
      const double distance = gap.norm();
      residuals[i] = distance / unit;
      if (!wanted) return;
      // The gradient of the distance to a set is the unit vector away from it, and 0 within.
      const Eigen::Vector3d away =
          distance > 1e-5 ? Eigen::Vector3d(gap / distance) : Eigen::Vector3d::Zero();
      slopes.row(static_cast<Eigen::Index>(i)) = away.transpose() * moves(pose, points_[i]) / unit;
    });
    for (int k = 0; k < 6; ++k) {
      residuals[n + k] = (pose[k] - start_[k]) / loose_[k];
      if (!wanted) continue;
      slopes.row(static_cast<Eigen::Index>(n) + k).setZero();
      slopes(static_cast<Eigen::Index>(n) + k, k) = 1 / loose_[k];
    }
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
  double size_ = 0;  // m, the drawing's radius
  double half_side_;
  Workers& workers_;
};

}  // namespace

Board refine_plane(const Board& board, const Reach& reach, const std::vector<Eigen::Vector2d>& points,
                   Workers& workers) {
  const Pose start = pose_of(board.plane);
  Pose pose = start;
  ceres::Problem problem;
  problem.AddResidualBlock(new Missed(reach, points, start, board.half_side, workers), nullptr, pose.data());
  ceres::Solver::Summary summary;
  ceres::Solve(dense_solver(15, 1e-3), &problem, &summary);
  return {plane_of(pose), board.half_side};
}

std::vector<double> distances_to_reach(const Board& board, const Reach& reach,
                                       const std::vector<Eigen::Vector2d>& points, Workers& workers) {
  std::vector<double> distances(points.size());
  workers.for_each(points.size(), [&](std::size_t i) {
    distances[i] = reach.nearest(board.plane.to_robot(points[i]), board, 8, 1e-5).gap.norm();
  });
  return distances;
}

}  // namespace hbr
