#include "pipeline/hierarchy/layers/arc_geometry.h"

#include <cmath>
#include <numbers>

#include "pipeline/core/check.h"

namespace hbr::inline hierarchy {
namespace {

double variance(std::span<const double> values) {
  const auto n = static_cast<double>(values.size());
  double mean = 0, sum = 0;
  for (const double v : values) mean += v / n;
  for (const double v : values) sum += (v - mean) * (v - mean) / n;
  return sum;
}

// Centre, relative to the first point, and length of the polygon through the points x(k), y(k). Plain
// arithmetic without branches, so that a loop over executions becomes vectors.
struct Place {
  double x, y, length;
};
template <class X, class Y>
[[gnu::always_inline]] inline Place place(ArcCentre centre, int points, const X& x, const Y& y) {
  constexpr double kRegularisation = 1e-6;  // of the points' spread
  const double share = 1.0 / points;
  double mean_x = 0, mean_y = 0, length = 0;
  for (int k = 1; k < points; ++k) {
    mean_x += (x(k) - x(0)) * share;
    mean_y += (y(k) - y(0)) * share;
  }
  for (int k = 1; k < points; ++k) {
    const double dx = x(k) - x(k - 1), dy = y(k) - y(k - 1);
    length += std::sqrt(dx * dx + dy * dy);
  }
  if (centre == ArcCentre::kCentroid) return {mean_x, mean_y, length};
  double xx = 0, xy = 0, yy = 0, moment_x = 0, moment_y = 0;
  for (int k = 0; k < points; ++k) {
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
  const double length = p.length / longest_arc(frame);
  return {(p.x * shorten + most) / (2 * most), (p.y * shorten + most) / (2 * most),
          length < 1 ? length : 1.0};
}

// An angle between two headings, brought into [-pi, pi].
double wrapped(double angle) {
  constexpr double kPi = std::numbers::pi;
  return angle > kPi ? angle - 2 * kPi : angle < -kPi ? angle + 2 * kPi : angle;
}

Place place_of(std::span<const Eigen::Vector2d> points, ArcCentre centre) {
  return place(
      centre, static_cast<int>(points.size()), [&](int k) { return points[k].x(); },
      [&](int k) { return points[k].y(); });
}

}  // namespace

Coordinates arc_coordinates(const Frame& frame) {
  Coordinates arc = plane_coordinates("centre", frame.half_side);
  arc.push_back({"length", "m", 0, longest_arc(frame)});
  return arc;
}

Eigen::Vector2d circle_centre(std::span<const Eigen::Vector2d> points) {
  const Place p = place_of(points, ArcCentre::kCircle);
  return points[0] + Eigen::Vector2d(p.x, p.y);
}

ArcShape arc_shape(std::span<const Eigen::Vector2d> points, ArcCentre centre) {
  const Place p = place_of(points, centre);
  return {{p.x, p.y}, p.length};
}

double irregularity(std::span<const Eigen::Vector2d> points, Turns turns) {
  const std::size_t segments = points.size() - 1;
  HBR_CHECK(segments >= 2 && segments <= kArcSegments, "{} segments", segments);
  std::array<double, kArcSegments> length, heading;
  std::array<double, kArcSegments - 1> turn;
  for (std::size_t i = 0; i < segments; ++i) {
    const Eigen::Vector2d v = points[i + 1] - points[i];
    length[i] = v.norm();
    heading[i] =
        turns.still_keeps_heading && length[i] == 0 && i > 0 ? heading[i - 1] : std::atan2(v.y(), v.x());
    if (i == 0) continue;
    const double by = wrapped(heading[i] - heading[i - 1]);
    turn[i - 1] = turns.without_sense ? std::abs(by) : by;
  }
  return 100 * variance({length.data(), segments}) + variance({turn.data(), segments - 1});
}

Eigen::Vector3d arc_descriptor(const Frame& frame, const ArcShape& shape) {
  const Descriptor3 d = descriptor(frame, {shape.centre.x(), shape.centre.y(), shape.length});
  return {d.x, d.y, d.length};
}

void arc_descriptors(const Frame& frame, ArcCentre centre, const ArcTracks& tracks, int n,
                     float* const* descriptor_of) {
  std::array<const float*, kArcSegments + 1> x, y;
  for (int k = 0; k <= kArcSegments; ++k) {
    x[k] = tracks.x[k].data();
    y[k] = tracks.y[k].data();
  }
  float* const out[3] = {descriptor_of[0], descriptor_of[1], descriptor_of[2]};
  const auto fill = [&](ArcCentre of) {
    const double metres = 2 * frame.half_side;
#ifdef __clang__
#pragma clang loop vectorize(assume_safety)
#else
#pragma GCC ivdep
#endif
    for (int s = 0; s < n; ++s) {
      const Place p = place(
          of, kArcSegments + 1, [&](int k) { return metres * x[k][s]; },
          [&](int k) { return metres * y[k][s]; });
      const Descriptor3 d = descriptor(frame, p);
      out[0][s] = static_cast<float>(d.x);
      out[1][s] = static_cast<float>(d.y);
      out[2][s] = static_cast<float>(d.length);
    }
  };
  // The branch stands outside of the loop.
  if (centre == ArcCentre::kCircle)
    fill(ArcCentre::kCircle);
  else
    fill(ArcCentre::kCentroid);
}

}  // namespace hbr::inline hierarchy
