#include "models/robot/looks/simplify.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "models/robot/looks/shapes.h"

namespace hbr {
namespace {

// The point of a triangle that is nearest to p, by the corners, edges and the face.
float distance_to(const Eigen::Vector3f& p, const Eigen::Vector3f (&corner)[3]) {
  float least = std::numeric_limits<float>::infinity();
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3f a = corner[k], along = corner[(k + 1) % 3] - a;
    const float t = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.f, 1.f);
    least = std::min(least, (a + t * along - p).norm());
  }
  const Eigen::Vector3f across = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
  bool inside = true;
  for (int k = 0; k < 3; ++k)
    inside = inside && (corner[(k + 1) % 3] - corner[k]).cross(p - corner[k]).dot(across) >= 0;
  return inside ? std::min(least, std::abs((p - corner[0]).dot(across.normalized()))) : least;
}

// The farthest of a mesh's vertices from another mesh's surface.
float farthest(const Mesh& from, const Mesh& to) {
  float most = 0;
  for (const Eigen::Vector3f& vertex : from.vertices) {
    float least = std::numeric_limits<float>::infinity();
    for (const Eigen::Vector3i& t : to.triangles)
      least = std::min(least, distance_to(vertex, {to.vertices[t[0]], to.vertices[t[1]], to.vertices[t[2]]}));
    most = std::max(most, least);
  }
  return most;
}

void expect_sound(const Mesh& mesh) {
  ASSERT_EQ(mesh.normals.size(), mesh.vertices.size());
  for (const Eigen::Vector3i& t : mesh.triangles) {
    ASSERT_GE(t.minCoeff(), 0);
    ASSERT_LT(t.maxCoeff(), static_cast<int>(mesh.vertices.size()));
  }
}

std::size_t count(const std::vector<Mesh>& meshes) {
  std::size_t sum = 0;
  for (const Mesh& mesh : meshes) sum += mesh.triangles.size();
  return sum;
}

// A cube of 12 triangles with corners and normals of its own for each, as STL has them.
Mesh loose_cube() {
  Mesh cube;
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-1.f, 1.f}) {
      Eigen::Vector3f n = Eigen::Vector3f::Zero(), u = n, v = n;
      n[axis] = side;
      u[(axis + 1) % 3] = 1;
      v[(axis + 2) % 3] = side;
      for (const float half : {-1.f, 1.f}) {
        const auto first = static_cast<int>(cube.vertices.size());
        for (const Eigen::Vector3f& corner :
             {Eigen::Vector3f(n - half * u - half * v), Eigen::Vector3f(n + half * u - half * v),
              Eigen::Vector3f(n + half * u + half * v)}) {
          cube.vertices.push_back(corner);
          cube.normals.push_back(n);
        }
        cube.triangles.emplace_back(first, first + 1, first + 2);
      }
    }
  return cube;
}

TEST(Simplified, StaysWithinTheDeviationOfTheOriginal) {
  Workers workers(2);
  const std::vector<Mesh> meshes{capsule(0.05, 0.2), rounded_box({0.2, 0.1, 0.3}, 0.03), torus(0.1, 0.02)};
  std::size_t before = 0;
  for (const std::size_t budget : {200u, 600u, 1200u}) {
    const Simplified result = simplified(meshes, budget, 0, workers);
    ASSERT_EQ(result.meshes.size(), 3u);
    EXPECT_LE(count(result.meshes), budget);
    EXPECT_GT(count(result.meshes), std::max(before, budget / 2));
    before = count(result.meshes);
    EXPECT_GT(result.deviation, 0);
    for (std::size_t i = 0; i < 3; ++i) {
      expect_sound(result.meshes[i]);
      // meshoptimizer's estimate is a mean over the triangles around a vertex.
      EXPECT_LT(farthest(meshes[i], result.meshes[i]), 3 * result.deviation) << i << " of " << budget;
      for (const Eigen::Vector3f& vertex : result.meshes[i].vertices)
        EXPECT_TRUE(std::ranges::count(meshes[i].vertices, vertex)) << "a vertex that was none before";
    }
  }
}

TEST(Simplified, LeavesWhatIsFewEnough) {
  Workers workers(1);
  const Mesh mesh = coloured(capsule(0.05, 0.2), {0.1f, 0.2f, 0.3f});
  const Simplified result = simplified({mesh}, mesh.triangles.size(), 0, workers);
  EXPECT_EQ(result.deviation, 0);
  EXPECT_EQ(result.meshes[0].triangles.size(), mesh.triangles.size());
  EXPECT_EQ(result.meshes[0].colour, mesh.colour);
  EXPECT_EQ(farthest(mesh, result.meshes[0]), 0);
}

TEST(Simplified, KeepsEdgesSharpAndFacesFlat) {
  Workers workers(1);
  Mesh cube = loose_cube();
  // Each triangle cut into four, twice: nothing to be seen, and all of it can go.
  for (int round = 0; round < 2; ++round) {
    Mesh finer;
    for (const Eigen::Vector3i& t : cube.triangles) {
      const Eigen::Vector3f a = cube.vertices[t[0]], b = cube.vertices[t[1]], c = cube.vertices[t[2]];
      const Eigen::Vector3f ab = (a + b) / 2, bc = (b + c) / 2, ca = (c + a) / 2;
      for (const auto& corners :
           {std::array{a, ab, ca}, std::array{ab, b, bc}, std::array{ca, bc, c}, std::array{ab, bc, ca}}) {
        const auto first = static_cast<int>(finer.vertices.size());
        for (const Eigen::Vector3f& corner : corners) {
          finer.vertices.push_back(corner);
          finer.normals.push_back(cube.normals[t[0]]);
        }
        finer.triangles.emplace_back(first, first + 1, first + 2);
      }
    }
    cube = finer;
  }
  const Simplified result = simplified({cube}, 1000, 1e-4, workers);
  EXPECT_EQ(result.meshes[0].triangles.size(), 12u);
  EXPECT_EQ(result.meshes[0].vertices.size(), 24u);
  for (const Eigen::Vector3i& t : result.meshes[0].triangles)
    for (const int corner : t) {
      const auto& [vertices, normals, triangles, colour, opacity] = result.meshes[0];
      const Eigen::Vector3f across =
          (vertices[t[1]] - vertices[t[0]]).cross(vertices[t[2]] - vertices[t[0]]).normalized();
      EXPECT_GT(normals[corner].dot(across), 0.999f);
    }
}

TEST(Simplified, IsTheSameForAnyNumberOfThreads) {
  Workers one(1), two(2);
  const std::vector<Mesh> meshes{ellipsoid({0.3, 0.2, 0.1}), capsule(0.05, 0.2)};
  const Simplified a = simplified(meshes, 500, 0, one), b = simplified(meshes, 500, 0, two);
  EXPECT_EQ(a.deviation, b.deviation);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(a.meshes[i].vertices, b.meshes[i].vertices);
    EXPECT_EQ(a.meshes[i].triangles, b.meshes[i].triangles);
  }
}

}  // namespace
}  // namespace hbr
