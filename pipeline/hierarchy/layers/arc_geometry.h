// Arcs: six points of the pen, what arc they make and how regular it is (paper, section 4.3 and figure 2).
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pipeline/hierarchy/coordinate.h"
#include "pipeline/hierarchy/frame.h"

namespace hbr::inline hierarchy {

inline constexpr int kArcSegments = 5;  // lines of an arc
inline double longest_arc(const Frame& frame) { return kArcSegments * frame.longest_line; }  // m
using ArcPoints = std::array<Eigen::Vector2d, kArcSegments + 1>;                             // m

// What C is: the centre of the circle fitted to the points, or their mean.
enum class ArcCentre { kCircle, kCentroid };

// Least-squares circle (Kasa 1976) through the points; its centre, m. A hair of regularisation brings the
// centre of collinear points back to their mean instead of infinity.
Eigen::Vector2d circle_centre(std::span<const Eigen::Vector2d> points);

// What the coordinates of an arc's descriptor are.
Coordinates arc_coordinates(const Frame& frame);

struct ArcShape {
  Eigen::Vector2d centre;  // C, relative to the first point, m
  double length;           // Lambda: of the drawn polygon, m
};
ArcShape arc_shape(std::span<const Eigen::Vector2d> points, ArcCentre centre = ArcCentre::kCircle);

// What the turn between two segments is.
struct Turns {
  bool without_sense = false;  // its magnitude: left and right are the same
  // A segment of no length has the heading of the one before it, and so no turn leads to it; otherwise that
  // of the x-axis.
  bool still_keeps_heading = false;
};

// 100 var |V_i| + var b_i, b_i the wrapped turn between successive segments; m^2, rad^2. 3 to 6 points.
double irregularity(std::span<const Eigen::Vector2d> points, Turns turns = {});

// Descriptor (C, Lambda) in [0, 1]^3. A centre farther than L is brought back along its direction to L; a
// length beyond the longest arc counts as the longest.
Eigen::Vector3d arc_descriptor(const Frame& frame, const ArcShape& shape);

// Many executions of arcs, one coordinate of one point after the other: x[k][s] in layer 1's descriptor
// units.
struct ArcTracks {
  std::array<std::vector<float>, kArcSegments + 1> x, y;
  void resize(std::size_t n) {
    for (auto* coordinates : {&x, &y})
      for (auto& values : *coordinates) values.resize(n);
  }
};
// The descriptors of the first n executions, coordinate d of execution i in descriptor[d][i]: the same as one
// by one.
void arc_descriptors(const Frame& frame, ArcCentre centre, const ArcTracks& tracks, int n,
                     float* const* descriptor);

}  // namespace hbr::inline hierarchy
