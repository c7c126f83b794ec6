#include "pipeline/artifact/profile.h"

#include <toml++/toml.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "pipeline/core/check.h"

namespace hbr {
namespace {

SettingsSource::Position position(const toml::source_region& region) {
  return {region.begin.line, region.begin.column};
}

nlohmann::json converted(const toml::node& node, const std::string& pointer, SettingsSource& source) {
  source.places[pointer] = position(node.source());
  if (const toml::table* table = node.as_table()) {
    nlohmann::json object = nlohmann::json::object();
    for (const auto& [key, value] : *table) {
      const std::string name(key.str());
      source.keys[pointer + "/" + name] = position(key.source());
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
    const toml::table table = toml::parse(text.str(), source.file);
    source.values = converted(table, "", source);
  } catch (const toml::parse_error& error) {
    std::string reason(error.description());
    if (reason.find("redefine") != std::string::npos) reason = "duplicate key: " + reason;
    throw InputError("{}:{}:{}: {}", source.file, error.source().begin.line, error.source().begin.column,
                     reason);
  }
  source.places[""] = {1, 1};
  return source;
}

}  // namespace hbr
