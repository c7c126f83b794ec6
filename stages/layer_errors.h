// How far lines and arcs go elsewhere when another robot's layer 1 takes the place of the one that they were
// evolved on (paper, section 5.2): executed over both from common starts, and held against what layers 2 and
// 3 promise of them.
#pragma once

#include <vector>

#include "pipeline/core/parallel.h"
#include "pipeline/hierarchy/arc_layer.h"

namespace hbr {

// A line, as each side asks for it: displacements, m.
struct LineTask {
  Eigen::Vector2d original, other;  // asked of each layer 1
  Eigen::Vector2d promise;          // what a descriptor says of it
};
struct ArcTask {
  using Requests = std::array<Eigen::Vector2d, kArcSegments>;
  Requests original, other;  // asked of each layer 1, line by line
  ArcShape promise;
};

// Layers 2 and 3 of one side.
struct Strokes {
  const LineLayer& lines;
  const ArcLayer& arcs;
};
// What either side executes where layer 2 is asked for its descriptors [n x 2] (and layer 3 for its, [n x
// 3]): the controllers that it has nearest to them.
std::vector<LineTask> line_tasks(const Frame& frame, const Rows& descriptors, const LineLayer& original,
                                 const LineLayer& other);
std::vector<ArcTask> arc_tasks(const Frame& frame, const Rows& descriptors, const Strokes& original,
                               const Strokes& other);

// Distances, one row per task and one column per start; metres of the frame (the arm's).
struct LineErrors {
  std::vector<float> end;           // between the end points
  std::vector<float> displacement;  // between the displacements V: layer 2's descriptor
  std::vector<float> promise;       // between the other's V and the promised one
};
struct ArcErrors {
  std::vector<float> end;
  std::vector<float> centre;  // between the centres C, relative to the start, none farther than L from it
  std::vector<float> length;  // between the drawn lengths, absolute
  std::vector<float> promised_centre, promised_length;  // between the other's and the promised ones
};

// Start s of task i is an elite of `original` drawn uniformly from seed.child(i); the other layer starts from
// its elite nearest to the place.
LineErrors line_errors(const PointLayer& original, const PointLayer& other,
                       const std::vector<LineTask>& tasks, int starts, Seed seed, Workers& workers);
ArcErrors arc_errors(const PointLayer& original, const PointLayer& other, const std::vector<ArcTask>& tasks,
                     ArcCentre centre, int starts, Seed seed, Workers& workers);

}  // namespace hbr
