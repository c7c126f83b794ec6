#include "pipeline/artifact/profile.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <vector>

#include "pipeline/core/check.h"

namespace hbr::inline artifact {
namespace {

using Positions = std::map<std::string, SettingsSource::Position>;

SettingsSource::Position position(const SettingsSource& source, const toml::source_region& region) {
  return {source.file, region.begin.line, region.begin.column};
}

nlohmann::json converted(const toml::node& node, const std::string& pointer, SettingsSource& source) {
  source.places[pointer] = position(source, node.source());
  if (const toml::table* table = node.as_table()) {
    nlohmann::json object = nlohmann::json::object();
    for (const auto& [key, value] : *table) {
      const std::string name(key.str());
      source.keys[pointer + "/" + name] = position(source, key.source());
      object[name] = converted(value, pointer + "/" + name, source);
    }
    return object;
  }
  if (const toml::array* array = node.as_array()) {
    nlohmann::json list = nlohmann::json::array();
    for (const toml::node& each : *array)
      list.push_back(converted(each, pointer + "/" + std::to_string(list.size()), source));
    return list;
  }
  if (const auto* integer = node.as_integer()) {
    // As nlohmann's own parser does, so that equal numbers have equal types.
    if (integer->get() >= 0) return static_cast<std::uint64_t>(integer->get());
    return integer->get();
  }
  if (const auto* number = node.as_floating_point()) return number->get();
  if (const auto* flag = node.as_boolean()) return flag->get();
  if (const auto* text = node.as_string()) return text->get();
  return nullptr;  // a date or time: no field takes one
}

// toml++ and what follows go down a key's parts one within the other.
constexpr std::ptrdiff_t kMostParts = 32;

void refuse_long_keys(const std::string& text, const std::string& file) {
  std::istringstream lines(text);
  std::string line;
  for (std::size_t number = 1; std::getline(lines, line); ++number) {
    const std::size_t first = line.find_first_not_of(" \t");
    if (first == std::string::npos || line[first] == '#') continue;
    const std::string key = line.substr(0, line[first] == '[' ? line.find(']') : line.find('='));
    if (std::ranges::count(key, '.') >= kMostParts)
      throw InputError("{}:{}:1: a key of more than {} parts; expected one of a profile's", file, number,
                       kMostParts);
  }
}

bool is_below(const std::string& pointer, const std::string& root) {
  return pointer.starts_with(root) && (pointer.size() == root.size() || pointer[root.size()] == '/');
}

// What stands at `pointer` and below it comes from `above`.
void replace_positions(Positions& below, const Positions& above, const std::string& pointer) {
  std::erase_if(below, [&](const auto& entry) { return is_below(entry.first, pointer); });
  for (auto entry = above.lower_bound(pointer); entry != above.end(); ++entry)
    if (is_below(entry->first, pointer)) below.insert(*entry);
}

void merge(SettingsSource& below, nlohmann::json& values, const SettingsSource& above,
           const nlohmann::json& changes, const std::string& pointer) {
  for (const auto& [key, change] : changes.items()) {
    const std::string inner = pointer + "/" + key;
    const auto found = values.find(key);
    if (found != values.end() && found->is_object() && change.is_object()) {
      for (const auto& [positions, from] :
           {std::pair{&below.keys, &above.keys}, std::pair{&below.places, &above.places}})
        if (const auto place = from->find(inner); place != from->end()) (*positions)[inner] = place->second;
      merge(below, *found, above, change, inner);
    } else {
      values[key] = change;
      replace_positions(below.keys, above.keys, inner);
      replace_positions(below.places, above.places, inner);
    }
  }
}

SettingsSource inherited(const std::filesystem::path& file, std::vector<std::filesystem::path>& heirs) {
  SettingsSource own = read_toml(file);
  if (!own.values.contains("base")) return own;
  const nlohmann::json base = own.values["base"];
  const SettingsSource::Position place = own.places["/base"];
  const std::string where = fmt::format("{}:{}:{}: base", place.file, place.line, place.column);
  if (!base.is_string() || base.get_ref<const std::string&>().empty())
    throw InputError("{}: expected a file's name (the profile that this one changes), found {}", where,
                     base.is_object() ? "a table" : base.dump());
  own.values.erase("base");

  heirs.push_back(std::filesystem::weakly_canonical(file));
  const std::filesystem::path below = (file.parent_path() / base.get<std::string>()).lexically_normal();
  if (std::find(heirs.begin(), heirs.end(), std::filesystem::weakly_canonical(below)) != heirs.end())
    throw InputError("{}: '{}' leads back to itself; expected a profile that does not build on this one",
                     where, below.string());
  if (!std::filesystem::is_regular_file(below))
    throw InputError("{}: there is no file '{}'; expected a path relative to the folder of {}", where,
                     below.string(), file.filename().string());
  SettingsSource source = inherited(below, heirs);
  source.values.erase("name");
  return laid_over(std::move(source), own);
}

}  // namespace

SettingsSource read_toml(const std::filesystem::path& file) {
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  if (!stream || std::filesystem::is_directory(file) || !(text << stream.rdbuf()))
    throw InputError("{}: can't read this profile: {}", file.string(),
                     std::filesystem::is_directory(file) ? "it is a folder"
                     : errno                             ? std::strerror(errno)
                                                         : "it is empty");
  SettingsSource source;
  source.file = file.string();
  try {
    refuse_long_keys(text.str(), source.file);
    const toml::table table = toml::parse(text.str(), source.file);
    source.values = converted(table, "", source);
  } catch (const toml::parse_error& error) {
    std::string reason(error.description());
    if (reason.find("redefine") != std::string::npos) reason = "duplicate key: " + reason;
    throw InputError("{}:{}:{}: {}", source.file, error.source().begin.line, error.source().begin.column,
                     reason);
  }
  source.places[""] = {source.file, 1, 1};
  return source;
}

SettingsSource laid_over(SettingsSource below, const SettingsSource& above) {
  merge(below, below.values, above, above.values, "");
  below.file = above.file;
  if (const auto place = above.places.find(""); place != above.places.end()) below.places[""] = place->second;
  return below;
}

SettingsSource part_of(const SettingsSource& source, const std::string& pointer) {
  SettingsSource part;
  part.values = source.values.at(nlohmann::json::json_pointer(pointer));
  part.file = source.file;
  for (const auto& [positions, from] :
       {std::pair{&part.keys, &source.keys}, std::pair{&part.places, &source.places}})
    for (const auto& [name, place] : *from)
      if (is_below(name, pointer)) (*positions)[name.substr(pointer.size())] = place;
  return part;
}

SettingsSource read_inheriting(const std::filesystem::path& file) {
  std::vector<std::filesystem::path> heirs;
  return inherited(file, heirs);
}

}  // namespace hbr::inline artifact
