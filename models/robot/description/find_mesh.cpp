#include "models/robot/description/find_mesh.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>

#include "pipeline/core/check.h"

namespace hbr {
namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

// The name without "scheme://".
std::string path_part(const std::string& name) {
  const std::size_t scheme = name.find("://");
  return scheme == std::string::npos ? name : name.substr(scheme + 3);
}

// A file below `folder` whose end is the end of `name`: as much of it as possible, then with other endings.
fs::path below(const fs::path& folder, const fs::path& name) {
  std::vector<fs::path> parts(name.begin(), name.end());
  for (std::size_t first = 0; first < parts.size(); ++first) {
    fs::path path = folder;
    for (std::size_t i = first; i < parts.size(); ++i)
      if (parts[i] != "/") path /= parts[i];
    if (is_file(path)) return path;
  }
  for (const char* ending : {".obj", ".dae", ".glb", ".gltf", ".stl", ".STL", ".ply"})
    if (const fs::path path = folder / (name.stem().string() + ending); is_file(path)) return path;
  return {};
}

// Other files that a mesh names: an OBJ its materials, a glTF its buffers.
std::vector<fs::path> named_by(const fs::path& mesh) {
  std::vector<fs::path> names;
  std::ifstream file(mesh, std::ios::binary);
  if (mesh.extension() == ".obj") {
    constexpr std::string_view kKey = "mtllib ";
    for (std::string line; std::getline(file, line);)
      if (line.starts_with(kKey)) names.emplace_back(line.substr(kKey.size(), line.find('\r') - kKey.size()));
  } else if (mesh.extension() == ".gltf") {
    const nlohmann::json all = nlohmann::json::parse(file, nullptr, false);
    if (all.is_object() && all.contains("buffers") && all["buffers"].is_array())
      for (const nlohmann::json& buffer : all["buffers"])
        if (buffer.is_object() && buffer.contains("uri") && buffer["uri"].is_string())
          names.emplace_back(buffer["uri"].get<std::string>());
  }
  std::vector<fs::path> found;
  for (const fs::path& name : names)
    if (const fs::path path = mesh.parent_path() / name; is_file(path)) found.push_back(path);
  return found;
}

}  // namespace

fs::path find_mesh(const std::string& name, const fs::path& urdf, const fs::path& folder) {
  const fs::path path = path_part(name);
  if (!folder.empty()) {
    if (const fs::path found = below(folder, path); !found.empty()) return found;
    throw InputError("{}: mesh '{}' is missing below the mesh folder {}", urdf.string(), name,
                     folder.string());
  }
  if (path.is_absolute()) {
    if (is_file(path)) return path;
    throw InputError("{}: mesh '{}' is missing", urdf.string(), name);
  }
  fs::path above = fs::absolute(urdf).parent_path();
  if (is_file(above / path)) return above / path;
  if (name.rfind("package://", 0) == 0)
    for (; above.has_relative_path(); above = above.parent_path())
      if (is_file(above.parent_path() / path)) return above.parent_path() / path;
  throw InputError("{}: mesh '{}' is missing, looked beside the URDF{}; name the folder that holds it",
                   urdf.string(), name, name.rfind("package://", 0) == 0 ? " and above" : "");
}

std::vector<fs::path> mesh_files(const RobotModel& model, const fs::path& folder) {
  std::vector<fs::path> files;
  const auto add = [&files](const fs::path& file) {
    if (std::ranges::find(files, file) == files.end()) files.push_back(file);
  };
  for (const Link& link : model.links)
    for (const Visual& visual : link.visuals) {
      if (visual.kind != Visual::Kind::mesh) continue;
      fs::path mesh;
      try {
        mesh = find_mesh(visual.mesh, model.path, folder);
      } catch (const InputError&) {
        continue;  // whoever needs it says so
      }
      add(mesh);
      for (const fs::path& other : named_by(mesh)) add(other);
    }
  return files;
}

}  // namespace hbr
