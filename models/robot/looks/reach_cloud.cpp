#include "models/robot/looks/reach_cloud.h"

#include <algorithm>
#include <cmath>

namespace hbr::inline robots {
namespace {

constexpr int kColours = 24;

// From blue by green and yellow to red.
Eigen::Vector3f colour_at(float share) {
  const Eigen::Vector3f stops[] = {
      {.16f, .25f, .75f}, {.10f, .62f, .62f}, {.95f, .78f, .20f}, {.85f, .15f, .12f}};
  const float at = 3 * std::clamp(share, 0.f, 1.f);
  const int before = std::min(2, static_cast<int>(at));
  return stops[before] + (at - static_cast<float>(before)) * (stops[before + 1] - stops[before]);
}

// An octahedron.
void add_point(Mesh& mesh, const Eigen::Vector3f& at, float radius) {
  const int first = static_cast<int>(mesh.vertices.size());
  for (int k = 0; k < 6; ++k) {
    mesh.normals.push_back(Eigen::Vector3f::Unit(k / 2) * (k % 2 ? -1.f : 1.f));
    mesh.vertices.push_back(at + radius * mesh.normals.back());
  }
  for (int octant = 0; octant < 8; ++octant) {
    const int x = octant & 1, y = octant >> 1 & 1, z = octant >> 2 & 1;
    Eigen::Vector3i t(first + x, first + 2 + y, first + 4 + z);
    if ((x + y + z) % 2) std::swap(t[1], t[2]);
    mesh.triangles.push_back(t);
  }
}

}  // namespace

Posed reach_cloud(const Chain& chain, int postures, double extent) {
  const std::vector<Eigen::Vector3d> points = reached_points(chain, postures);
  double farthest = 0;
  for (const Eigen::Vector3d& point : points) farthest = std::max(farthest, (point - chain.base()).norm());
  Posed cloud{"reach of " + chain.link, std::vector<Mesh>(kColours)};
  for (int k = 0; k < kColours; ++k) {
    cloud.meshes[k].colour = colour_at(static_cast<float>(k) / (kColours - 1));
    cloud.meshes[k].opacity = .3f;
  }
  for (const Eigen::Vector3d& point : points) {
    const double share = farthest > 0 ? (point - chain.base()).norm() / farthest : 0;
    add_point(cloud.meshes[static_cast<std::size_t>(share * (kColours - 1))], point.cast<float>(),
              static_cast<float>(.002 * extent));
  }
  return cloud;
}

}  // namespace hbr::inline robots
