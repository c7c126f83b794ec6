#include "models/robot/looks/triangles.h"

#include <cmath>

namespace hbr::inline robots {
namespace {

float to_linear(float c) { return std::pow(c, 2.2f); }

}  // namespace

Eigen::Vector3f to_linear(const Eigen::Vector3f& c) {
  return {to_linear(c[0]), to_linear(c[1]), to_linear(c[2])};
}

std::vector<Triangle> triangles_of(const std::vector<Posed>& bodies, bool solid) {
  std::size_t count = 0;
  for (const Posed& body : bodies)
    for (const Mesh& mesh : body.meshes) count += (mesh.opacity >= 1) == solid ? mesh.triangles.size() : 0;
  std::vector<Triangle> result;
  result.reserve(count);
  for (const Posed& body : bodies) {
    const Eigen::Isometry3f pose = body.pose.cast<float>();
    for (const Mesh& mesh : body.meshes) {
      if ((mesh.opacity >= 1) != solid) continue;
      for (const Eigen::Vector3i& t : mesh.triangles) {
        Triangle out;
        out.colour = to_linear(mesh.colour);
        out.opacity = mesh.opacity;
        for (int k = 0; k < 3; ++k) {
          out.corner[k] = pose * mesh.vertices[t[k]];
          out.normal[k] = pose.linear() * mesh.normals[t[k]];
        }
        result.push_back(out);
      }
    }
  }
  return result;
}

Eigen::Matrix3f axes_along(const Eigen::Vector3f& forward) {
  Eigen::Matrix3f m;
  const Eigen::Vector3f right = forward.cross(Eigen::Vector3f::UnitZ()).normalized();
  m.row(0) = right;
  m.row(1) = forward.cross(right);
  m.row(2) = forward;
  return m;
}

}  // namespace hbr::inline robots
