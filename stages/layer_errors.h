// How far lines and arcs end elsewhere when another robot's layer 1 takes the place of the one that they were
// evolved on (paper, section 5.2): the same controllers, executed over both from common starts.
#pragma once

#include <vector>

#include "pipeline/core/parallel.h"
#include "pipeline/hierarchy/arc_layer.h"

namespace hbr {

// Distances, one row per controller and one column per start; metres of the frame (the arm's).
struct LineErrors {
  std::vector<float> end;           // between the end points
  std::vector<float> displacement;  // between the displacements V: layer 2's descriptor
};
struct ArcErrors {
  std::vector<float> end;
  std::vector<float> centre;  // between the centres C, relative to the start, none farther than L from it
  std::vector<float> length;  // between the drawn lengths, absolute
};

// Start s of controller i is an elite of `original` drawn uniformly from seed.child(i); the other layer
// starts from its elite nearest to the place.
LineErrors line_errors(const PointLayer& original, const PointLayer& other,
                       const std::vector<Eigen::Vector2d>& requests, int starts, Seed seed, Workers& workers);
ArcErrors arc_errors(const PointLayer& original, const PointLayer& other, const LineLayer& lines,
                     const std::vector<ArcLines>& arcs, ArcCentre centre, int starts, Seed seed,
                     Workers& workers);

}  // namespace hbr
