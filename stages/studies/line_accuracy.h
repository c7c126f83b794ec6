// How well lines draw what they are asked for (paper, section 5.3): every contender gets the same requests.
#pragma once

#include <vector>

#include "pipeline/core/parallel.h"
#include "pipeline/core/random.h"
#include "pipeline/hierarchy/layer.h"
#include "pipeline/hierarchy/point_layer.h"

namespace hbr::inline stages {

// Displacements wanted [m], each from an elite of layer 1.
struct LineRequests {
  std::vector<Eigen::Vector2d> wanted;
  std::vector<std::int32_t> start;
};

// Directions and lengths up to `longest_line` [m] are drawn uniformly, so short lines are as frequent as long
// ones.
LineRequests draw_line_requests(int n, const PointLayer& points, double longest_line, Rng rng);

// Squared distances between what was wanted and what was drawn [n], m^2, by the elites of a layer of lines
// that are nearest to what was wanted. `frame` has the layer's descriptor.
std::vector<float> squared_line_errors(const LineRequests& requests, const PointLayer& points,
                                       const Frame& frame, const Layer& lines);

// The same of the reference, whose elites are those for a start and a displacement [4]. Replaying one means
// to go where it ended, or to ask for the displacement that it asked for.
struct ReferenceErrors {
  std::vector<float> endpoint, displacement;
};
ReferenceErrors squared_reference_errors(const LineRequests& requests, const PointLayer& points,
                                         const Frame& frame, const Elites& reference, Workers& workers);

}  // namespace hbr::inline stages
