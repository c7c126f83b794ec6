#include "pipeline/hierarchy/arc_geometry.h"

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

// Centre of the fitted circle, relative to the first point, and length of the polygon through the points
// x(k), y(k). Plain arithmetic without branches, so that a loop over executions becomes vectors.
struct Place {
  double x, y, length;
};
template <class X, class Y>
inline Place place(const X& x, const Y& y) {
  constexpr double kRegularisation = 1e-6;  // of the points' spread
  constexpr int kPoints = kArcSegments + 1;
  double mean_x = 0, mean_y = 0, length = 0;
  for (int k = 0; k < kPoints; ++k) {
    mean_x += (x(k) - x(0)) / kPoints;
    mean_y += (y(k) - y(0)) / kPoints;
  }
  for (int k = 1; k < kPoints; ++k) {
    const double dx = x(k) - x(k - 1), dy = y(k) - y(k - 1);
    length += std::sqrt(dx * dx + dy * dy);
  }
  double xx = 0, xy = 0, yy = 0, moment_x = 0, moment_y = 0;
  for (int k = 0; k < kPoints; ++k) {
    const double dx = x(k) - x(0) - mean_x, dy = y(k) - y(0) - mean_y, half = (dx * dx + dy * dy) / 2;
    xx += dx * dx;
    xy += dx * dy;
    yy += dy * dy;
    moment_x += half * dx;
    moment_y += half * dy;
  }
  const double ridge = kRegularisation * (xx + yy) + 1e-300;  // something even where all points are one
  xx += ridge;
  yy += ridge;
  const double scale = 1 / (xx * yy - xy * xy + 1e-300);
  return {mean_x + (yy * moment_x - xy * moment_y) * scale, mean_y + (xx * moment_y - xy * moment_x) * scale,
          length};
}

struct Descriptor3 {
  double x, y, length;
};
inline Descriptor3 descriptor(const Frame& frame, const Place& p) {
  const double distance = std::sqrt(p.x * p.x + p.y * p.y), most = frame.half_side;
  const double shorten = distance > most ? most / distance : 1.0;
  const double length = p.length / frame.longest_arc();
  return {(p.x * shorten + most) / (2 * most), (p.y * shorten + most) / (2 * most),
          length < 1 ? length : 1.0};
}

double wrapped(double angle) { return std::remainder(angle, 2 * std::numbers::pi); }

}  // namespace

Eigen::Vector2d circle_centre(const ArcPoints& points) {
  const Place p = place([&](int k) { return points[k].x(); }, [&](int k) { return points[k].y(); });
  return points[0] + Eigen::Vector2d(p.x, p.y);
}

ArcShape arc_shape(const ArcPoints& points) {
  const Place p = place([&](int k) { return points[k].x(); }, [&](int k) { return points[k].y(); });
  return {{p.x, p.y}, p.length};
}

double irregularity(const ArcPoints& points) {
  std::array<double, kArcSegments> length, heading;
  std::array<double, kArcSegments - 1> turn;
  for (int i = 0; i < kArcSegments; ++i) {
    const Eigen::Vector2d v = points[i + 1] - points[i];
    length[i] = v.norm();
    heading[i] = std::atan2(v.y(), v.x());
    if (i > 0) turn[i - 1] = wrapped(heading[i] - heading[i - 1]);
  }
  return 100 * variance(length) + variance(turn);
}

Eigen::Vector3d arc_descriptor(const Frame& frame, const ArcShape& shape) {
  const Descriptor3 d = descriptor(frame, {shape.centre.x(), shape.centre.y(), shape.length});
  return {d.x, d.y, d.length};
}

void arc_descriptors(const Frame& frame, const ArcTracks& tracks, Samples<3>& descriptors) {
  const auto n = static_cast<int>(tracks.x[0].size());
  descriptors.resize(n);
  std::array<const double*, kArcSegments + 1> x, y;
  for (int k = 0; k <= kArcSegments; ++k) {
    x[k] = tracks.x[k].data();
    y[k] = tracks.y[k].data();
  }
  float* const out[3] = {descriptors.coordinate(0), descriptors.coordinate(1), descriptors.coordinate(2)};
#pragma GCC ivdep
  for (int s = 0; s < n; ++s) {
    const Place p = place([&](int k) { return x[k][s]; }, [&](int k) { return y[k][s]; });
    const Descriptor3 d = descriptor(frame, p);
    out[0][s] = static_cast<float>(d.x);
    out[1][s] = static_cast<float>(d.y);
    out[2][s] = static_cast<float>(d.length);
  }
}

Eigen::Vector3d decode_arc(const Frame& frame, const float* genes) {
  const Eigen::Vector2d centre =
      frame.point_descriptor(at_most(frame.point(Eigen::Vector2d(genes[0], genes[1])), frame.half_side));
  return {centre.x(), centre.y(), genes[2]};
}

}  // namespace hbr
