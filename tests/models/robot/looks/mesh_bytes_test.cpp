#include "models/robot/looks/mesh_bytes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/robot/looks/shapes.h"
#include "pipeline/core/check.h"

namespace hbr {
namespace {

using testing::StartsWith;
using testing::ThrowsMessage;

std::vector<Mesh> two() { return {coloured(capsule(.1, .5), {.25f, .5f, .75f}), rounded_box({1, 2, 3}, .1)}; }

TEST(MeshBytes, ComeBackAsTheyWere) {
  const std::vector<Mesh> meshes = two(), back = unpacked("a.obj", packed(meshes));
  ASSERT_EQ(back.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back[i].vertices, meshes[i].vertices);
    EXPECT_EQ(back[i].normals, meshes[i].normals);
    EXPECT_EQ(back[i].triangles, meshes[i].triangles);
    EXPECT_EQ(back[i].colour, meshes[i].colour);
  }
  EXPECT_TRUE(unpacked("a.obj", "").empty());
}

TEST(MeshBytes, OfAReaderThatWentAstrayAreRefused) {
  const auto refused = [](const std::string& bytes) {
    EXPECT_THAT([&] { unpacked("a.obj", bytes); },
                ThrowsMessage<InputError>(StartsWith("a.obj: the reader")));
  };
  Mesh mesh;
  mesh.vertices.assign(3, {1, 2, 3});
  mesh.normals.assign(3, {0, 0, 1});
  mesh.triangles = {{0, 1, 2}};
  const std::string good = packed({mesh});
  for (std::size_t n = 1; n < good.size(); ++n) refused(good.substr(0, n));
  refused(good + "more");
  std::string endless = good;
  endless.replace(0, 8, 8, '\xff');  // vertices
  refused(endless);
  for (const int vertex : {-1, 3}) {
    mesh.triangles = {{0, vertex, 2}};
    refused(packed({mesh}));
  }
}

}  // namespace
}  // namespace hbr
