#include "models/robot/looks/mesh_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>

#include "models/robot/looks/shapes.h"
#include "pipeline/core/check.h"
#include "tests/models/robot/description/urdf_text.h"
#include "tests/models/robot/looks/mesh_volume.h"

namespace hbr {
namespace {

// Triangles of a that b does not have, corners in the same order around.
int unmatched(const Mesh& a, const Mesh& b) {
  const auto corner = [](const Mesh& mesh, const Eigen::Vector3i& t, int k) {
    return mesh.vertices[t[k % 3]];
  };
  return static_cast<int>(std::ranges::count_if(a.triangles, [&](const Eigen::Vector3i& t) {
    return std::ranges::none_of(b.triangles, [&](const Eigen::Vector3i& other) {
      for (int turn = 0; turn < 3; ++turn) {
        float apart = 0;
        for (int k = 0; k < 3; ++k)
          apart = std::max(apart, (corner(a, t, k) - corner(b, other, k + turn)).norm());
        if (apart < 1e-6f) return true;
      }
      return false;
    });
  }));
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
  Eigen::Isometry3d up = Eigen::Isometry3d::Identity();
  if (path.extension() == ".glb" || path.extension() == ".gltf")  // written with y up
    up.rotate(Eigen::AngleAxisd(-std::numbers::pi / 2, Eigen::Vector3d::UnitX()));
  EXPECT_EQ(unmatched(moved(shape, up), back[0]), 0);
  EXPECT_EQ(back[0].triangles.size(), shape.triangles.size());
  EXPECT_NEAR(volume(back), volume({shape}), 1e-6);
  if (std::string(name) != "a.stl") {  // which knows no colour
    EXPECT_LT((back[0].colour - shape.colour).norm(), 0.02);
  }
}
INSTANTIATE_TEST_SUITE_P(MeshFile, Formats,
                         testing::Values(std::pair{"obj", "a.obj"}, std::pair{"glb2", "a.glb"},
                                         std::pair{"gltf2", "a.gltf"}, std::pair{"stlb", "a.stl"},
                                         std::pair{"stl", "a.stl"}, std::pair{"collada", "a.dae"}),
                         [](const auto& file) { return std::string(file.param.first); });

TEST(MeshFile, ScaleAndMirrorKeepFacesOutward) {
  const TestFolder folder;
  save_scene(folder.path() / "a.obj", "obj", {{"shape", {capsule(.1, .5)}}});
  const double once = volume(load_meshes(folder.path() / "a.obj"));
  EXPECT_NEAR(volume(load_meshes(folder.path() / "a.obj", {2, 2, 2})), 8 * once, 1e-5);
  EXPECT_NEAR(volume(load_meshes(folder.path() / "a.obj", {1, -1, 1})), once, 1e-6);
}

// A ball stretched to an ellipsoid: its normals are (x / a^2, y / b^2, z / c^2), also in the mirror.
TEST(MeshFile, NormalsFollowAnUnevenScale) {
  const TestFolder folder;
  save_scene(folder.path() / "a.obj", "obj", {{"ball", {ellipsoid({1, 1, 1})}}});
  for (const Eigen::Vector3d& scale : {Eigen::Vector3d(1, 2, 4), Eigen::Vector3d(-3, 1, 1)})
    for (const Mesh& mesh : load_meshes(folder.path() / "a.obj", scale))
      for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        const Eigen::Vector3d vertex = mesh.vertices[i].cast<double>();
        const Eigen::Vector3d outward = vertex.cwiseQuotient(scale).cwiseQuotient(scale).normalized();
        EXPECT_GT(mesh.normals[i].cast<double>().dot(outward), .98) << vertex.transpose();
      }
}

// A binary STL that says it has `count` triangles and has those of the floats.
std::string stl(std::uint32_t count, const std::vector<std::array<float, 12>>& triangles) {
  std::string text(80, ' ');
  text.append(reinterpret_cast<const char*>(&count), 4);
  for (const auto& t : triangles) text.append(reinterpret_cast<const char*>(&t), 48).append(2, '\0');
  return text;
}

// A cube with its faces' normals, or with normals of length 0.
std::string cube_stl(bool normals) {
  std::vector<std::array<float, 12>> triangles;
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-1.f, 1.f}) {
      const Eigen::Vector3f n = side * Eigen::Vector3f::Unit(axis), u = Eigen::Vector3f::Unit((axis + 1) % 3),
                            v = n.cross(u);
      for (const float half : {-1.f, 1.f}) {
        const Eigen::Vector3f corners[] = {n + half * (u + v), n + half * (v - u), n - half * (u + v)};
        std::array<float, 12> t{};
        for (int i = 0; i < 3; ++i) {
          t[i] = normals ? n[i] : 0;
          for (int k = 0; k < 3; ++k) t[3 + 3 * k + i] = corners[k][i];
        }
        triangles.push_back(t);
      }
    }
  return stl(static_cast<std::uint32_t>(triangles.size()), triangles);
}

// A glTF of one triangle: its positions and indices are in `uri`, `bytes` long.
std::string gltf(const std::string& uri, int bytes, int vertices = 3,
                 const std::string& nodes = "{\"mesh\": 0}") {
  return fmt::format(
      R"({{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0]}}], "nodes": [{}],
          "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}, "indices": 1}}]}}],
          "buffers": [{{"uri": "{}", "byteLength": {}}}],
          "bufferViews": [{{"buffer": 0, "byteOffset": 0, "byteLength": 36}},
                          {{"buffer": 0, "byteOffset": 36, "byteLength": 6}}],
          "accessors": [{{"bufferView": 0, "componentType": 5126, "count": {}, "type": "VEC3"}},
                        {{"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}}]}})",
      nodes, uri, bytes, vertices);
}

// A DAE of one triangle.
std::string dae(const std::string& count, const std::string& numbers, const std::string& indices,
                const std::string& nodes = "", const std::string& asset = "") {
  return fmt::format(
      R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">{}
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="f" count="{}">{}</float_array><technique_common>
<accessor source="#f" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>{}</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node>{}<instance_geometry url="#g"/></node></visual_scene>
</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>)",
      asset, count, numbers, indices, nodes);
}

std::string repeated(int n, const std::string& text) {
  std::string result;
  for (int i = 0; i < n; ++i) result += text;
  return result;
}

const std::string kCorners = "0 0 0 1 0 0 0 1 0";
// Three corners as floats, then 0, 1 and `last` as 16-bit indices.
std::string buffer(std::uint16_t last) {
  const float corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::uint16_t indices[] = {0, 1, last};
  return std::string(reinterpret_cast<const char*>(corners), 36) +
         std::string(reinterpret_cast<const char*>(indices), 6);
}

// What the bad ones below are made of is good.
TEST(MeshFile, TakesTheSmallestOfEachFormat) {
  const TestFolder folder;
  folder.write("good.bin", buffer(2));
  for (const auto& path :
       {folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
        folder.write("a.stl", stl(1, {{0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0}})),
        folder.write("a.gltf", gltf("good.bin", 42)), folder.write("a.dae", dae("9", kCorners, "0 1 2"))}) {
    const auto meshes = load_meshes(path, {1, 1, 1}, {.1f, .2f, .3f});
    ASSERT_EQ(meshes.size(), 1u) << path;
    EXPECT_EQ(meshes[0].triangles.size(), 1u) << path;
    if (path.extension() == ".stl" || path.extension() == ".obj") {  // which say no colour
      EXPECT_EQ(meshes[0].colour, Eigen::Vector3f(.1f, .2f, .3f)) << path;
    }
  }
}

// A link's mesh stands as its numbers say whatever is up elsewhere; its unit counts.
TEST(MeshFile, TakesTheUnitOfADaeAndNotItsUpAxis) {
  const TestFolder folder;
  for (const char* up : {"X_UP", "Y_UP", "Z_UP"}) {
    const auto path = folder.write(
        "a.dae", dae("9", "0 0 0 1 0 0 0 0 2", "0 1 2", "",
                     fmt::format("<asset><unit meter=\"0.01\"/><up_axis>{}</up_axis></asset>", up)));
    const std::vector<Mesh> meshes = load_meshes(path);
    Eigen::AlignedBox3f box;
    for (const Eigen::Vector3f& vertex : meshes.at(0).vertices) box.extend(vertex);
    EXPECT_LT((box.max() - Eigen::Vector3f(.01f, 0, .02f)).norm(), 1e-7f) << up;
    EXPECT_LT(box.min().norm(), 1e-7f) << up;
  }
}

// Programs that know no normals write those of length 0: then they are the triangles', also after an export.
TEST(MeshFile, NormalsOfNoLengthAreTheTriangles) {
  const TestFolder folder;
  for (const bool normals : {true, false}) {
    const auto read = load_meshes(folder.write("cube.stl", cube_stl(normals)));
    EXPECT_NEAR(volume(read), 8, 1e-5);
    save_scene(folder.path() / "cube.glb", "glb2", {{"cube", read}});
    for (const auto& meshes : {read, load_meshes(folder.path() / "cube.glb")})
      for (const Mesh& mesh : meshes)
        for (const Eigen::Vector3i& t : mesh.triangles) {
          const Eigen::Vector3f &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
          for (const int corner : t)
            EXPECT_LT((mesh.normals[corner] - (b - a).cross(c - a).normalized()).norm(), 1e-5f) << normals;
        }
  }
  // Triangles without area have none, and a direction of some kind.
  for (const char* name : {"a.stl", "a.obj"}) {
    const std::string text =
        std::string(name) == "a.stl"
            ? stl(2, {{0, 0, 0, 0, 0, 0, 1, 0, 0, 2, 0, 0}, {0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0}})
            : "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 4\n";
    for (const Mesh& mesh : load_meshes(folder.write(name, text)))
      for (const Eigen::Vector3f& normal : mesh.normals) EXPECT_NEAR(normal.norm(), 1, 1e-5) << name;
  }
}

// A texture is not drawn; what it covers is often said to be black.
TEST(MeshFile, BlackUnderATextureIsNoColour) {
  const TestFolder folder;
  const std::string obj = "mtllib a.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const Eigen::Vector3f ours(.1f, .2f, .3f);
  const auto colour = [&](const std::string& material) {
    folder.write("a.mtl", "newmtl m\n" + material);
    return load_meshes(folder.write("a.obj", obj), {1, 1, 1}, ours)[0].colour;
  };
  EXPECT_EQ(colour("Kd 0 0 0\nmap_Kd wood.png\n"), ours);
  EXPECT_EQ(colour("Kd 0 0 0\n"), Eigen::Vector3f(0, 0, 0));
  EXPECT_EQ(colour("Kd 0 .5 0\nmap_Kd wood.png\n"), Eigen::Vector3f(0, .5f, 0));
}

TEST(MeshFile, RefusesWhatIsNoMesh) {
  const TestFolder folder;
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const float nan = std::numeric_limits<float>::quiet_NaN();
  folder.write("good.bin", buffer(2));
  folder.write("beyond.bin", buffer(9));
  struct BadFile {
    std::string name, text, expected;
  };
  const std::string not_read = "not a mesh that can be read";
  const BadFile bad[] = {
      {"empty.obj", "", not_read},
      {"words.obj", "once upon a time\n", "."},
      {"points.obj", triangle, "."},
      {"index.obj", triangle + "f 1 2 9\n", not_read},
      {"nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "."},
      {"infinite.obj", "v 1e999 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "not finite"},
      {"short.stl", "solid", "."},
      {"words.stl", "once upon a time", not_read},
      {"none.stl", stl(0, {}), "."},
      {"count.stl", stl(7, {{0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0}}), not_read},
      {"huge.stl", stl(0x7fffffff, {{0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0}}), not_read},
      {"nan.stl", stl(1, {{0, 0, 1, nan, 0, 0, 1, 0, 0, 0, 1, 0}}), "not finite"},
      {"words.dae", "<COLLADA><library_geometries>", not_read},
      {"empty.dae", "<?xml version=\"1.0\"?><COLLADA/>", not_read},
      {"index.dae", dae("9", kCorners, "0 1 9"), "."},
      {"few.dae", dae("9", "0 0 0 1 0", "0 1 2"), not_read},
      {"count.dae", dae("4000000000", kCorners, "0 1 2"), "."},
      {"deep.dae", dae("9", kCorners, "0 1 2", repeated(200000, "<node>") + repeated(200000, "</node>")),
       "."},
      {"torn.glb", std::string("glTF\x02\0\0\0\xff\xff\xff\x7f", 12), not_read},
      {"words.glb", "once upon a time", not_read},
      {"bad.gltf", R"({"asset": {"version": "2.0"}, "meshes": 3})", not_read},
      {"missing.gltf", gltf("missing.bin", 42), "missing.bin"},
      {"twice.gltf", R"({"buffers": [],)" + gltf("good.bin", 42).substr(1), "stands twice"},
      {"folder.gltf", gltf("../", 42), not_read},
      {"small.gltf", gltf("good.bin", 42000), not_read},
      {"index.gltf", gltf("beyond.bin", 42), "."},
      {"count.gltf", gltf("good.bin", 42, 3000000), not_read},
      {"circle.gltf", gltf("good.bin", 42, 3, R"({"mesh": 0, "children": [0]})"), not_read},
      {"deep.gltf", std::string(3000000, '['), "."},
      {"picture.png", "\x89PNG\r\n\x1a\n", not_read},
      {"unknown.xyz", "once", not_read},
  };
  for (const auto& [name, text, expected] : bad) {
    const auto path = folder.write(name, text);
    try {
      load_meshes(path);
      ADD_FAILURE() << name << " taken without a word";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::StartsWith(path.string() + ": "));
      EXPECT_THAT(error.what(), testing::ContainsRegex(expected));
      EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("\n")));
    }
  }
  EXPECT_THROW(load_meshes(folder.path() / "missing.obj"), InputError);
  EXPECT_THROW(load_meshes(folder.path()), InputError);
  EXPECT_THROW(load_meshes(folder.write("huge.obj", "v 0 0 0\nv 1e8 0 0\nv 0 1 0\nf 1 2 3\n"), {100, 1, 1}),
               InputError);
}

TEST(MeshFile, RefusesAPlaceItCannotWrite) {
  EXPECT_THROW(save_scene("/nowhere/a.obj", "obj", {{"a", {capsule(1, 1)}}}), InputError);
}

}  // namespace
}  // namespace hbr
