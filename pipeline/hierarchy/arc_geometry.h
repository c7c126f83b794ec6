// Arcs: six points of the pen, what arc they make and how regular it is (paper, section 4.3 and figure 2).
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "pipeline/hierarchy/frame.h"
#include "pipeline/hierarchy/geometric_median.h"

namespace hbr {

inline constexpr int kArcSegments = 5;
using ArcPoints = std::array<Eigen::Vector2d, kArcSegments + 1>;  // m

// Least-squares circle (Kasa 1976) through the points; its centre, m. A hair of regularisation brings the
// centre of collinear points back to their mean instead of infinity.
Eigen::Vector2d circle_centre(const ArcPoints& points);

struct ArcShape {
  Eigen::Vector2d centre;  // C: of the fitted circle, relative to the first point, m
  double length;           // Lambda: of the drawn polygon, m
};
ArcShape arc_shape(const ArcPoints& points);

// 100 var |V_i| + var b_i, b_i the wrapped turn between successive segments; m^2, rad^2.
double irregularity(const ArcPoints& points);

// Descriptor (C, Lambda) in [0, 1]^3. A centre farther than L is brought back along its direction to L; a
// length beyond the longest arc counts as the longest.
Eigen::Vector3d arc_descriptor(const Frame& frame, const ArcShape& shape);

// Many executions of an arc, one coordinate of one point after the other: x[k][s], m.
struct ArcTracks {
  std::array<std::vector<double>, kArcSegments + 1> x, y;
  void resize(std::size_t n) {
    for (auto* coordinates : {&x, &y})
      for (auto& values : *coordinates) values.resize(n);
  }
};
// The descriptors of all of them: the same as one by one.
void arc_descriptors(const Frame& frame, const ArcTracks& tracks, Samples<3>& descriptors);

// The place of layer 3's descriptor that three genes in [0, 1] mean, the centre brought back likewise.
Eigen::Vector3d decode_arc(const Frame& frame, const float* genes);

}  // namespace hbr
