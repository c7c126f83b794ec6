// Meshes with fewer triangles, for pictures that travel.
#pragma once

#include <cstddef>
#include <vector>

#include "models/robot/looks/mesh.h"
#include "pipeline/core/parallel.h"

namespace hbr::inline robots {

struct Simplified {
  std::vector<Mesh> meshes;  // one of each, in their order
  double deviation;          // m: what was allowed, by meshoptimizer's own estimate
};

// The same surfaces with at most so many triangles in all, all of them as exact as each other: they deviate
// by `enough` [m], or by the least that gets there. Vertices are some of the original ones, with the original
// normals, so edges stay sharp. There may be more triangles where fewer would leave nothing of a mesh.
Simplified simplified(const std::vector<Mesh>& meshes, std::size_t triangles, double enough,
                      Workers& workers);

}  // namespace hbr::inline robots
