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
  folder.write("pack/meshes/f 1%.obj", "");
  const auto found = [&](const std::string& name, const std::filesystem::path& given = "") {
    const FoundMesh mesh = find_mesh(name, urdf, given);
    EXPECT_FALSE(mesh.elsewhere) << name;
    return mesh.path;
  };
  EXPECT_EQ(found("meshes/b.obj"), at / "pack/urdf/meshes/b.obj");
  EXPECT_EQ(found("meshes\\b.obj"), at / "pack/urdf/meshes/b.obj");
  EXPECT_EQ(found("package://pack/meshes/c.obj"), at / "pack/meshes/c.obj");
  EXPECT_EQ(found("file://" + (at / "pack/meshes/c.obj").string()), at / "pack/meshes/c.obj");
  EXPECT_EQ(found("file://" + (at / "pack/meshes/f%201%25.obj").string()), at / "pack/meshes/f 1%.obj");
  EXPECT_EQ(found("package://other/meshes/e.obj", at / "mine"), at / "mine/meshes/e.obj");
  EXPECT_EQ(found("/other/meshes/e.obj", at / "mine"), at / "mine/meshes/e.obj");
  EXPECT_EQ(found("meshes/d.obj", at / "mine"), at / "mine/d.dae");
  EXPECT_THROW(find_mesh("package://pack/meshes/z.obj", urdf, ""), InputError);
  EXPECT_THROW(find_mesh("meshes/b.obj", urdf, at / "mine"), InputError);
  EXPECT_THROW(find_mesh("/z.obj", urdf, ""), InputError);
  EXPECT_THROW(find_mesh("", urdf, ""), InputError);
  EXPECT_THROW(find_mesh("..", urdf, ""), InputError);
}

TEST(FindMesh, FindsWhatWasMovedAndSaysSo) {
  const TestFolder folder;
  const auto& at = folder.path();
  const auto urdf = at / "pack/urdf/a.urdf";
  for (const char* inner :
       {"pack/urdf", "pack/meshes/visual", "pack/inner/meshes", "mine/deep/meshes", "mine/meshes/visual"})
    std::filesystem::create_directories(at / inner);
  folder.write("pack/meshes/a.obj", "");
  folder.write("pack/meshes/visual/b.obj", "");
  folder.write("pack/inner/meshes/c.obj", "");
  folder.write("mine/deep/meshes/d.obj", "");
  folder.write("mine/meshes/visual/e.obj", "");
  for (const auto& [name, given, expected] :
       {std::tuple("package://renamed/meshes/a.obj", "", "pack/meshes/a.obj"),
        {"meshes/a.obj", "", "pack/meshes/a.obj"},
        {"file:///home/maker/pack/meshes/a.obj", "", "pack/meshes/a.obj"},
        {"package://pack/meshes/b.obj", "", "pack/meshes/visual/b.obj"},
        {"package://renamed/meshes/b.obj", "", "pack/meshes/visual/b.obj"},
        {"package://pack/meshes/c.obj", "", "pack/inner/meshes/c.obj"},
        {"package://pack/meshes/d.obj", "mine", "mine/deep/meshes/d.obj"},
        {"package://pack/meshes/e.obj", "mine", "mine/meshes/visual/e.obj"},
        {"package://mine/meshes/e.obj", "mine", "mine/meshes/visual/e.obj"}}) {
    const FoundMesh found = find_mesh(name, urdf, *given ? at / given : "");
    EXPECT_EQ(found.path, at / expected) << name;
    EXPECT_TRUE(found.elsewhere) << name;
  }
  // What is where its name says goes before all else.
  std::filesystem::create_directories(at / "pack/urdf/meshes");
  folder.write("pack/urdf/meshes/a.obj", "");
  EXPECT_EQ(find_mesh("meshes/a.obj", urdf, "").path, at / "pack/urdf/meshes/a.obj");
  EXPECT_FALSE(find_mesh("meshes/a.obj", urdf, "").elsewhere);
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
  folder.write("b.gltf", R"({"buffers": [{"uri": "b.bin"}, {"uri": "data:x"}, {}]})");
  folder.write("b.bin", "");
  EXPECT_THAT(mesh_files(model, ""),
              testing::ElementsAre(at / "a.obj", at / "a.mtl", at / "b.gltf", at / "b.bin"));
  // A glTF that does not tell its buffers is refused by whoever reads it.
  for (const auto& [text, told] :
       {std::pair("{", "not JSON: at line 1"),
        {R"({"buffers": [{"uri": "b.bin"}], "buffers": [{"uri": "c.bin"}]})",
         "the key \"buffers\" stands twice"},
        {"{\"name\": \"\xff\", \"buffers\": [{\"uri\": \"b.bin\"}]}", "not JSON: at line 1"},
        {R"([{"uri": "b.bin"}])", "expected a table"},
        {R"({"buffers": {"uri": "b.bin"}})", "buffers: expected a list of tables"},
        {R"({"buffers": [{"uri": "b.bin"}, 3]})", "buffers: expected a list of tables"},
        {R"({"buffers": [{"uri": 3}]})", "buffers: expected a list of tables"}}) {
    folder.write("b.gltf", text);
    EXPECT_THAT([&] { named_by_mesh(at / "b.gltf"); },
                testing::ThrowsMessage<InputError>(testing::AllOf(
                    testing::StartsWith((at / "b.gltf").string() + ": not a mesh that can be read: "),
                    testing::HasSubstr(told))));
    EXPECT_THAT(mesh_files(model, ""), testing::ElementsAre(at / "a.obj", at / "a.mtl", at / "b.gltf"));
  }
  // A file's end is the same in capitals, and what a glTF names is an address.
  const RobotModel loud = load_urdf(folder.write(
      "b.urdf", robot(link("a", shows("A.OBJ")) + link("b", shows("B.GLTF")) + joint("i", "a", "b"))));
  folder.write("A.OBJ", "mtllib a.mtl\n");
  folder.write("B.GLTF", R"({"buffers": [{"uri": "b%20b.bin"}]})");
  folder.write("b b.bin", "");
  EXPECT_THAT(mesh_files(loud, ""),
              testing::ElementsAre(at / "A.OBJ", at / "a.mtl", at / "B.GLTF", at / "b b.bin"));
  std::filesystem::create_directories(at / "mine");
  folder.write("mine/a.dae", "");
  EXPECT_THAT(mesh_files(model, at / "mine"), testing::ElementsAre(at / "mine/a.dae"));
}

}  // namespace
}  // namespace hbr
