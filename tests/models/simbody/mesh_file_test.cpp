#include "models/simbody/mesh_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/simbody/shapes.h"
#include "pipeline/core/check.h"
#include "tests/models/simbody/urdf_text.h"

namespace hbr {
namespace {

double volume(const std::vector<Mesh>& meshes) {
  double sum = 0;
  for (const Mesh& mesh : meshes)
    for (const Eigen::Vector3i& t : mesh.triangles)
      sum += mesh.vertices[t[0]].cast<double>().dot(
                 mesh.vertices[t[1]].cast<double>().cross(mesh.vertices[t[2]].cast<double>())) /
             6;
  return sum;
}

TEST(Shapes, HaveTheVolumeOfTheirBodies) {
  const double pi = 3.14159265358979;
  EXPECT_NEAR(volume({ellipsoid({1, 2, 3})}), 4 * pi / 3 * 6, 0.6);
  EXPECT_NEAR(volume({capsule(1, 3)}), pi * 3 + 4 * pi / 3, 0.3);
  EXPECT_NEAR(volume({cylinder(1, 2, 1e-3)}), 2 * pi, 0.05);
  EXPECT_NEAR(volume({torus(3, 1)}), 2 * pi * pi * 3, 2.);
  EXPECT_NEAR(volume({rounded_box({1, 2, 3}, 1e-3)}), 6, 0.3);
  EXPECT_NEAR(volume({rod({1, 0, 0}, {1, 5, 0}, .5)}), pi * .25 * 5 + pi / 6, 0.1);
  EXPECT_NEAR(volume({mirrored(capsule(1, 3))}), volume({capsule(1, 3)}), 1e-5);
}

class Formats : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(Formats, ComeBackAsTheyWere) {
  const TestFolder folder;
  const auto [format, name] = GetParam();
  const auto path = folder.path() / name;
  const Mesh shape = coloured(capsule(.1, .5), {.25f, .5f, .75f});
  save_scene(path, format, {{"shape", {shape}}});
  const std::vector<Mesh> back = load_meshes(path);
  ASSERT_EQ(back.size(), 1u);
  EXPECT_EQ(back[0].triangles.size(), shape.triangles.size());
  EXPECT_NEAR(volume(back), volume({shape}), 1e-6);
  if (std::string(format) != "stlb") {  // which knows no colour
    EXPECT_LT((back[0].colour - shape.colour).norm(), 0.02);
  }
}
INSTANTIATE_TEST_SUITE_P(MeshFile, Formats,
                         testing::Values(std::pair{"obj", "a.obj"}, std::pair{"glb2", "a.glb"},
                                         std::pair{"stlb", "a.stl"}, std::pair{"collada", "a.dae"}));

TEST(MeshFile, ScaleAndMirrorKeepFacesOutward) {
  const TestFolder folder;
  save_scene(folder.path() / "a.obj", "obj", {{"shape", {capsule(.1, .5)}}});
  const double once = volume(load_meshes(folder.path() / "a.obj"));
  EXPECT_NEAR(volume(load_meshes(folder.path() / "a.obj", {2, 2, 2})), 8 * once, 1e-5);
  EXPECT_NEAR(volume(load_meshes(folder.path() / "a.obj", {1, -1, 1})), once, 1e-6);
}

TEST(MeshFile, FindsMeshes) {
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

TEST(MeshFile, RefusesWhatIsNoMesh) {
  const TestFolder folder;
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const std::pair<const char*, std::string> bad[] = {
      {"empty.obj", ""},
      {"words.obj", "once upon a time\n"},
      {"points.obj", triangle},
      {"index.obj", triangle + "f 1 2 9\n"},
      {"nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
      {"torn.stl", std::string(80, 'x') + "\xff\xff\xff\x7f" + std::string(100, '\0')},
      {"short.stl", "solid"},
      {"words.stl", "once upon a time"},
      {"words.dae", "<COLLADA><library_geometries>"},
      {"empty.dae", "<?xml version=\"1.0\"?><COLLADA/>"},
      {"torn.glb", std::string("glTF\x02\0\0\0\xff\xff\xff\x7f", 12)},
      {"words.glb", "once upon a time"},
      {"bad.gltf", "{\"asset\": {\"version\": \"2.0\"}, \"meshes\": 3}"},
      {"picture.png", "\x89PNG\r\n\x1a\n"},
      {"unknown.xyz", "once"},
  };
  for (const auto& [name, text] : bad) {
    const auto path = folder.write(name, text);
    try {
      load_meshes(path);
      ADD_FAILURE() << name << " taken without a word";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(name));
      EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("\n")));
    }
  }
  EXPECT_THROW(load_meshes(folder.path() / "missing.obj"), InputError);
  EXPECT_THROW(load_meshes(folder.path()), InputError);
}

TEST(MeshFile, RefusesAPlaceItCannotWrite) {
  EXPECT_THROW(save_scene("/nowhere/a.obj", "obj", {{"a", {capsule(1, 1)}}}), InputError);
}

TEST(LinkMeshes, MakeTheShapesOfTheUrdf) {
  const TestFolder folder;
  const auto shape = [](const std::string& inside) {
    return "<visual><origin xyz=\"1 2 3\"/><geometry>" + inside +
           "</geometry><material name=\"m\"><color rgba=\"1 0 0 1\"/></material></visual>";
  };
  const RobotModel model = load_urdf(folder.write(
      "a.urdf", robot(link("a", shape("<box size=\"1 2 3\"/>") + shape("<sphere radius=\"2\"/>") +
                                    shape("<cylinder radius=\"1\" length=\"4\"/>")))));
  const auto meshes = link_meshes(model, "", 1);
  ASSERT_EQ(meshes[0].size(), 3u);
  const double expected[] = {6, 4 * 3.14159 / 3 * 8, 3.14159 * 4};
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(meshes[0][i].colour, Eigen::Vector3f(1, 0, 0));
    EXPECT_NEAR(volume({moved(meshes[0][i], Eigen::Isometry3d(Eigen::Translation3d(-1, -2, -3)))}),
                expected[i], 0.06 * expected[i]);
  }
}

}  // namespace
}  // namespace hbr
