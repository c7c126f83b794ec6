#include "pipeline/hierarchy/arc_geometry.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace hbr {
namespace {

template <std::size_t N>
double variance(const std::array<double, N>& values) {
  double mean = 0, sum = 0;
  for (const double v : values) mean += v / N;
  for (const double v : values) sum += (v - mean) * (v - mean) / N;
  return sum;
}

double wrapped(double angle) { return std::remainder(angle, 2 * std::numbers::pi); }

}  // namespace

Eigen::Vector2d circle_centre(const ArcPoints& points) {
  constexpr double kRegularisation = 1e-6;  // of the points' spread
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const auto& p : points) mean += p / points.size();
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  for (const auto& p : points) {
    const Eigen::Vector2d q = p - mean;
    spread += q * q.transpose();
    moment += q * (q.squaredNorm() / 2);
  }
  const double ridge = kRegularisation * spread.trace();
  if (ridge == 0) return mean;  // all points are one
  spread.diagonal().array() += ridge;
  return mean + spread.inverse() * moment;
}

ArcShape arc_shape(const ArcPoints& points) {
  std::array<double, kArcSegments> length, heading;
  std::array<double, kArcSegments - 1> turn;
  double total = 0;
  for (int i = 0; i < kArcSegments; ++i) {
    const Eigen::Vector2d v = points[i + 1] - points[i];
    total += length[i] = v.norm();
    heading[i] = std::atan2(v.y(), v.x());
    if (i > 0) turn[i - 1] = wrapped(heading[i] - heading[i - 1]);
  }
  return {circle_centre(points) - points[0], total, 100 * variance(length) + variance(turn)};
}

Eigen::Vector3d arc_descriptor(const Frame& frame, const ArcShape& shape) {
  const Eigen::Vector2d centre = frame.point_descriptor(at_most(shape.centre, frame.half_side));
  return {centre.x(), centre.y(), std::min(1.0, shape.length / frame.longest_arc())};
}

Eigen::Vector3d decode_arc(const Frame& frame, const float* genes) {
  const Eigen::Vector2d centre =
      frame.point_descriptor(at_most(frame.point(Eigen::Vector2d(genes[0], genes[1])), frame.half_side));
  return {centre.x(), centre.y(), genes[2]};
}

}  // namespace hbr
