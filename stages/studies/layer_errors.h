// How far lines and arcs go elsewhere when another robot's layer 1 takes the place of the one that they were
// evolved on (paper, section 5.2): executed over both from common starts, and held against what their layers
// promise of them.
#pragma once

#include <vector>

#include "pipeline/core/parallel.h"
#include "pipeline/hierarchy/layers/arcs.h"
#include "pipeline/hierarchy/stack.h"

namespace hbr::inline stages {

// A layer of lines or arcs and the points by which it is executed.
struct Side {
  const PointLayer& points;
  const Layer& layer;
};

// Distances, one row per command and one column per start; metres of the frame (the arm's).
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

// Both sides are asked for each of these descriptors [n x d], which promise what is drawn. Start s of command
// i is an elite of the original's points drawn uniformly from seed.child(i); the other starts from its elite
// nearest to the place. Arcs are executed as their layer says.
LineErrors line_errors(const Frame& frame, const Rows& commands, const Side& original, const Side& other,
                       int starts, Seed seed, Workers& workers);
ArcErrors arc_errors(const LayerModel& arcs, const Rows& commands, const Side& original, const Side& other,
                     int starts, Seed seed, Workers& workers);

}  // namespace hbr::inline stages
