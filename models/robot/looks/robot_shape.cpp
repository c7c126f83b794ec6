#include "models/robot/looks/robot_shape.h"

#include <algorithm>

#include "pipeline/core/check.h"

namespace hbr::inline robots {
namespace {

void append(Mesh& to, const Mesh& mesh) {
  const auto first = static_cast<int>(to.vertices.size());
  to.vertices.insert(to.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
  to.normals.insert(to.normals.end(), mesh.normals.begin(), mesh.normals.end());
  for (const Eigen::Vector3i& t : mesh.triangles) to.triangles.emplace_back(t.array() + first);
}

}  // namespace

RobotShape shape_of(const Body& body, const std::vector<std::vector<Mesh>>& meshes, std::size_t triangles,
                    double enough, Workers& workers) {
  const MovingParts moving = body.moving_parts();
  HBR_CHECK(meshes.size() == moving.places.size(), "meshes of {} links, expected {}", meshes.size(),
            moving.places.size());
  std::vector<Mesh> all;  // in the frames of their links
  std::vector<std::size_t> link;
  for (std::size_t i = 0; i < meshes.size(); ++i)
    for (const Mesh& mesh : meshes[i]) {
      all.push_back(mesh);
      link.push_back(i);
    }
  const Simplified simple = simplified(all, triangles, enough, workers);
  RobotShape shape{moving.parts, {}, simple.deviation};
  for (int part = 0; part < static_cast<int>(moving.parts.size()); ++part) {
    const auto first = static_cast<std::ptrdiff_t>(shape.pieces.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Parts::Place& place = moving.places[link[i]];
      if (place.part != part || simple.meshes[i].triangles.empty()) continue;
      const Mesh placed = moved(simple.meshes[i], place.pose);
      const auto same =
          std::find_if(shape.pieces.begin() + first, shape.pieces.end(), [&](const RobotShape::Piece& piece) {
            return piece.mesh.colour == placed.colour && piece.mesh.opacity == placed.opacity;
          });
      if (same == shape.pieces.end())
        shape.pieces.push_back({part, placed});
      else
        append(same->mesh, placed);
    }
  }
  return shape;
}

}  // namespace hbr::inline robots
