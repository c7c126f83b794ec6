#include "models/robot/description/find_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/core/check.h"
#include "tests/models/robot/description/urdf_text.h"

namespace hbr {
namespace {

TEST(FindMesh, LooksBesideAboveAndInTheFolder) {
  const TestFolder folder;
  const auto& at = folder.path();
  std::filesystem::create_directories(at / "pack/urdf/meshes");
  std::filesystem::create_directories(at / "pack/meshes");
  std::filesystem::create_directories(at / "mine/meshes");
  const auto urdf = at / "pack/urdf/a.urdf";
  folder.write("pack/urdf/meshes/b.obj", "");
  folder.write("pack/meshes/c.obj", "");
  folder.write("mine/d.dae", "");
  folder.write("mine/meshes/e.obj", "");
  EXPECT_EQ(find_mesh("meshes/b.obj", urdf, ""), at / "pack/urdf/meshes/b.obj");
  EXPECT_EQ(find_mesh("package://pack/meshes/c.obj", urdf, ""), at / "pack/meshes/c.obj");
  EXPECT_EQ(find_mesh("file://" + (at / "pack/meshes/c.obj").string(), urdf, ""), at / "pack/meshes/c.obj");
  EXPECT_EQ(find_mesh("package://other/meshes/e.obj", urdf, at / "mine"), at / "mine/meshes/e.obj");
  EXPECT_EQ(find_mesh("meshes/d.obj", urdf, at / "mine"), at / "mine/d.dae");
  EXPECT_THROW(find_mesh("meshes/c.obj", urdf, ""), InputError);
  EXPECT_THROW(find_mesh("package://pack/meshes/z.obj", urdf, ""), InputError);
  EXPECT_THROW(find_mesh("meshes/b.obj", urdf, at / "mine"), InputError);
  EXPECT_THROW(find_mesh("/z.obj", urdf, ""), InputError);
}

TEST(MeshFiles, AreAllThatARobotLooksLike) {
  const TestFolder folder;
  const auto& at = folder.path();
  const auto shows = [](const std::string& mesh) {
    return inertial() + "<visual><geometry><mesh filename=\"" + mesh + "\"/></geometry></visual>";
  };
  const RobotModel model = load_urdf(
      folder.write("a.urdf", robot(link("a", shows("a.obj")) + link("b", shows("b.gltf")) +
                                   link("c", shows("a.obj")) + link("d", shows("none.stl")) +
                                   joint("i", "a", "b") + joint("j", "b", "c") + joint("k", "c", "d"))));
  folder.write("a.obj", "# mtllib not.mtl\nmtllib a.mtl\r\nmtllib gone.mtl\nv 0 0 0\n");
  folder.write("a.mtl", "");
  folder.write("not.mtl", "");
  folder.write("b.gltf", R"({"buffers": [{"uri": "b.bin"}, {"uri": "data:x"}, {}, 3]})");
  folder.write("b.bin", "");
  EXPECT_THAT(mesh_files(model, ""),
              testing::ElementsAre(at / "a.obj", at / "a.mtl", at / "b.gltf", at / "b.bin"));
  folder.write("b.gltf", "{");
  EXPECT_THAT(mesh_files(model, ""), testing::ElementsAre(at / "a.obj", at / "a.mtl", at / "b.gltf"));
  std::filesystem::create_directories(at / "mine");
  folder.write("mine/a.dae", "");
  EXPECT_THAT(mesh_files(model, at / "mine"), testing::ElementsAre(at / "mine/a.dae"));
}

}  // namespace
}  // namespace hbr
