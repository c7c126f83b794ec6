#include "models/robot/looks/mesh.h"

#include <algorithm>
#include <cmath>

namespace hbr::inline robots {

void smooth_normals(Mesh& mesh) {
  mesh.normals.assign(mesh.vertices.size(), Eigen::Vector3f::Zero());
  for (const Eigen::Vector3i& t : mesh.triangles) {
    const Eigen::Vector3f &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    const Eigen::Vector3f area = (b - a).cross(c - a);
    for (const int corner : t) mesh.normals[corner] += area;
  }
  for (Eigen::Vector3f& normal : mesh.normals) {
    const float length = normal.norm();
    normal = length > 0 ? Eigen::Vector3f(normal / length) : Eigen::Vector3f::UnitZ();
  }
}

void mend_normals(Mesh& mesh) {
  const auto is_direction = [](const Eigen::Vector3f& n) { return std::abs(n.squaredNorm() - 1) < 1e-3f; };
  if (std::ranges::all_of(mesh.normals, is_direction)) return;
  for (Eigen::Vector3i& t : mesh.triangles) {
    const Eigen::Vector3f a = mesh.vertices[t[0]], b = mesh.vertices[t[1]], c = mesh.vertices[t[2]];
    Eigen::Vector3f across = (b - a).cross(c - a).stableNormalized();
    if (!is_direction(across)) across = Eigen::Vector3f::UnitZ();  // no area, not to be seen
    for (int& corner : t) {
      if (is_direction(mesh.normals[corner])) continue;
      const Eigen::Vector3f vertex = mesh.vertices[corner];
      corner = static_cast<int>(mesh.vertices.size());
      mesh.vertices.push_back(vertex);
      mesh.normals.push_back(across);
    }
  }
  for (Eigen::Vector3f& normal : mesh.normals)
    if (!is_direction(normal)) normal = Eigen::Vector3f::UnitZ();  // of no triangle any more
}

Mesh moved(Mesh mesh, const Eigen::Isometry3d& pose) {
  const Eigen::Isometry3f p = pose.cast<float>();
  for (Eigen::Vector3f& vertex : mesh.vertices) vertex = p * vertex;
  for (Eigen::Vector3f& normal : mesh.normals) normal = p.linear() * normal;
  return mesh;
}

Mesh coloured(Mesh mesh, const Eigen::Vector3f& colour) {
  mesh.colour = colour;
  return mesh;
}

Mesh mirrored(Mesh mesh) {
  for (Eigen::Vector3f& vertex : mesh.vertices) vertex[1] = -vertex[1];
  for (Eigen::Vector3f& normal : mesh.normals) normal[1] = -normal[1];
  for (Eigen::Vector3i& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

}  // namespace hbr::inline robots
