#include "models/robot/looks/mesh.h"

namespace hbr {

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

}  // namespace hbr
