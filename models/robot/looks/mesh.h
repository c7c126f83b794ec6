// Triangle meshes: closed surfaces of one colour each, counter-clockwise seen from outside.
#pragma once

#include <Eigen/Geometry>
#include <vector>

namespace hbr::inline robots {

struct Mesh {
  std::vector<Eigen::Vector3f> vertices;     // m
  std::vector<Eigen::Vector3f> normals;      // unit, one per vertex
  std::vector<Eigen::Vector3i> triangles;    // indices
  Eigen::Vector3f colour{0.9f, 0.9f, 0.9f};  // red, green, blue in [0, 1]
  float opacity = 1;                         // in (0, 1]; below 1 it is seen through
};

// Vertex normals as the mean of the triangles around, weighted by their areas.
void smooth_normals(Mesh& mesh);
// Some programs write normals of length 0: a triangle's corner with one becomes a vertex of its own, whose
// normal is the triangle's.
void mend_normals(Mesh& mesh);

Mesh moved(Mesh mesh, const Eigen::Isometry3d& pose);
Mesh coloured(Mesh mesh, const Eigen::Vector3f& colour);
// Seen in the mirror of the x-z plane (left becomes right).
Mesh mirrored(Mesh mesh);

}  // namespace hbr::inline robots
