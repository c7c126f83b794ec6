#include "models/robot/description/find_mesh.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <fstream>
#include <iterator>
#include <string_view>

#include "pipeline/core/check.h"
#include "pipeline/core/json_text.h"

namespace hbr::inline robots {
namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

// "a b" of "a%20b".
std::string decoded(const std::string& uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned code = 0;
    if (uri[i] == '%' && i + 2 < uri.size()) {
      const char* const digits = uri.data() + i + 1;
      if (std::from_chars(digits, digits + 2, code, 16).ptr != digits + 2) code = 0;
    }
    text += code ? static_cast<char>(code) : uri[i];
    if (code) i += 2;
  }
  return text;
}

// The name without "scheme://", as a path of this system.
fs::path path_part(std::string name) {
  std::ranges::replace(name, '\\', '/');
  const std::size_t scheme = name.find("://");
  if (scheme == std::string::npos) return name;
  const std::string path = name.substr(scheme + 3);
  return name.starts_with("file:") ? decoded(path) : path;
}

// "a/b/c", "b/c" and "c".
std::vector<fs::path> tails(const fs::path& path) {
  std::vector<fs::path> result;
  for (auto part = path.end(); part != path.begin();) {
    if (*--part == "/") break;
    result.insert(result.begin(), result.empty() ? *part : *part / result.front());
  }
  return result;
}

std::vector<fs::path> folders_in(const fs::path& folder) {
  std::vector<fs::path> result;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (entry.is_directory(ignored)) result.push_back(entry.path());
  std::ranges::sort(result);
  return result;
}

// A file below `folder` whose end is the end of `name`: as much of it as possible, then with other endings.
fs::path below(const fs::path& folder, const fs::path& name) {
  for (const fs::path& tail : tails(name))
    if (is_file(folder / tail)) return folder / tail;
  for (const char* ending : {".obj", ".dae", ".glb", ".gltf", ".stl", ".STL", ".ply"})
    if (const fs::path path = folder / (name.stem().string() + ending); is_file(path)) return path;
  return {};
}

// `name` with one folder more somewhere on its way from `folder` on.
fs::path one_deeper(const fs::path& folder, const fs::path& name) {
  fs::path reached = folder;
  for (const fs::path& rest : tails(name)) {
    for (const fs::path& inner : folders_in(reached))
      if (is_file(inner / rest)) return inner / rest;
    reached /= *rest.begin();
  }
  return {};
}

// The same, with the package's name and without.
fs::path one_deeper_in(const std::vector<fs::path>& folders, const std::vector<fs::path>& ends) {
  for (std::size_t i = 0; i < std::min<std::size_t>(2, ends.size()); ++i)
    for (const fs::path& folder : folders)
      if (const fs::path found = one_deeper(folder, ends[i]); !found.empty()) return found;
  return {};
}

// Near the URDF, though not where its name says.
fs::path near(const fs::path& urdf, const fs::path& name) {
  std::vector<fs::path> above{fs::absolute(urdf).parent_path()};
  for (int level = 0; level < 3 && above.back().has_relative_path(); ++level)
    above.push_back(above.back().parent_path());
  const std::vector<fs::path> ends = tails(name);
  for (const fs::path& end : ends)
    for (const fs::path& folder : above)
      if (is_file(folder / end)) return folder / end;
  return one_deeper_in(above, ends);
}

// Of a glTF's buffers.
std::vector<fs::path> buffers_of(const fs::path& mesh) {
  std::ifstream file(mesh, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}},
      where = mesh.string() + ": not a mesh that can be read";
  const nlohmann::json all = parse_json(text, where);
  const auto is_buffer = [](const nlohmann::json& buffer) {
    return buffer.is_object() && (!buffer.contains("uri") || buffer["uri"].is_string());
  };
  if (!all.is_object()) throw InputError("{}: expected a table, as glTF is", where);
  std::vector<fs::path> names;
  if (!all.contains("buffers")) return names;
  const nlohmann::json& buffers = all["buffers"];
  if (!buffers.is_array() || !std::ranges::all_of(buffers, is_buffer))
    throw InputError("{}: buffers: expected a list of tables whose 'uri', if any, is a text", where);
  for (const nlohmann::json& buffer : buffers)
    if (buffer.contains("uri")) names.emplace_back(decoded(buffer["uri"].get<std::string>()));
  return names;
}

// Of an OBJ's materials.
std::vector<fs::path> materials_of(const fs::path& mesh) {
  constexpr std::string_view kKey = "mtllib ";
  std::vector<fs::path> names;
  std::ifstream file(mesh, std::ios::binary);
  for (std::string line; std::getline(file, line);)
    if (line.starts_with(kKey)) names.emplace_back(line.substr(kKey.size(), line.find('\r') - kKey.size()));
  return names;
}

}  // namespace

FoundMesh find_mesh(const std::string& name, const fs::path& urdf, const fs::path& folder) {
  const fs::path path = path_part(name);
  if (!folder.empty()) {
    if (const fs::path found = below(folder, path); !found.empty()) return {found};
    for (const fs::path& inner : folders_in(folder))
      if (const fs::path found = below(inner, path); !found.empty()) return {found, true};
    if (const fs::path found = one_deeper_in({folder}, tails(path)); !found.empty()) return {found, true};
    throw InputError("{}: mesh '{}' is missing below the mesh folder {}", urdf.string(), name,
                     folder.string());
  }
  fs::path above = fs::absolute(urdf).parent_path();
  if (is_file(above / path)) return {above / path};  // also where the path is absolute
  if (name.starts_with("package://"))
    for (; above.has_relative_path(); above = above.parent_path())
      if (is_file(above.parent_path() / path)) return {above.parent_path() / path};
  if (const fs::path found = near(urdf, path); !found.empty()) return {found, true};
  throw InputError(
      "{}: mesh '{}' is missing, looked beside the URDF and above; name the folder that holds it "
      "(MESHES of make robot, meshes of a profile's robot)",
      urdf.string(), name);
}

std::vector<fs::path> named_by_mesh(const fs::path& mesh) {
  std::string ending = mesh.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  std::vector<fs::path> names, found;
  if (ending == ".obj") names = materials_of(mesh);
  if (ending == ".gltf") names = buffers_of(mesh);
  for (const fs::path& name : names)
    if (const fs::path path = mesh.parent_path() / name; is_file(path)) found.push_back(path);
  return found;
}

std::vector<fs::path> mesh_files(const RobotModel& model, const fs::path& folder) {
  std::vector<fs::path> files;
  const auto add = [&files](const fs::path& file) {
    if (std::ranges::find(files, file) == files.end()) files.push_back(file);
  };
  for (const Link& link : model.links)
    for (const Visual& visual : link.visuals) {
      if (visual.kind != Visual::Kind::mesh) continue;
      try {
        const fs::path mesh = find_mesh(visual.mesh, model.path, folder).path;
        add(mesh);
        for (const fs::path& other : named_by_mesh(mesh)) add(other);
      } catch (const InputError&) {  // whoever reads the mesh says so
      }
    }
  return files;
}

}  // namespace hbr::inline robots
