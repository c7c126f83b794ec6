// A mesh. assimp reads it in a process of its own, because it crashes on damaged files; so what is held here
// is what stays in ours: that this process lives, and says in one line what became of the other. Beside it,
// the names of other files that a mesh holds, which we read ourselves. The first byte says which format.
#include "models/robot/description/find_mesh.h"
#include "models/robot/looks/mesh_bytes.h"
#include "models/robot/looks/mesh_file.h"
#include "pipeline/core/check.h"
#include "tests/fuzz/fuzz.h"

namespace hbr::fuzz {
namespace {

constexpr std::pair<const char*, const char*> kFormats[] = {{"obj", "a.obj"},    {"stl", "a.stl"},
                                                            {"stlb", "b.stl"},   {"collada", "a.dae"},
                                                            {"gltf2", "a.gltf"}, {"glb2", "a.glb"}};

}  // namespace

std::vector<std::string> examples() {
  std::vector<std::string> all;
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  smooth_normals(mesh);
  for (std::size_t i = 0; i < std::size(kFormats); ++i) {
    save_scene(folder() / kFormats[i].second, kFormats[i].first, {{"a", {mesh}}});
    all.push_back(static_cast<char>(i) + content_of_file(folder() / kFormats[i].second));
  }
  return all;
}

void read(const std::string& bytes) {
  if (bytes.empty()) return;
  and_go_on([&] { unpacked("mesh", bytes.substr(1)); });  // what the other process may say astray
  const auto format = static_cast<unsigned char>(bytes[0]) % std::size(kFormats);
  const std::filesystem::path path = written(kFormats[format].second, bytes.substr(1));
  RobotModel model{"", folder() / "robot.urdf", {Link{"a", {}, {}}}, {}, {}};
  model.links[0].visuals.push_back(
      {Visual::Kind::mesh, Eigen::Isometry3d::Identity(), path.string(), {1, 1, 1}, {}});
  and_go_on([&] { mesh_files(model, ""); });
  load_meshes(path);
}

}  // namespace hbr::fuzz
