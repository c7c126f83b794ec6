#include "stages/plan/profile_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "pipeline/core/check.h"
#include "pipeline/core/settings_list.h"
#include "pipeline/hierarchy/layers.h"
#include "stages/layers/search_settings.h"
#include "stages/plan/profile.h"

namespace hbr::inline stages {
namespace {

using nlohmann::json;

// "autoencoder.epochs" of the profile's values; "" of a list of tables, and of what it does not say.
std::string value_of(const json& values, const std::string& name) {
  const json* at = &values;
  for (std::size_t begin = 0; begin <= name.size();) {
    const std::size_t end = std::min(name.find('.', begin), name.size());
    const auto found = at->is_object() ? at->find(name.substr(begin, end - begin)) : at->end();
    if (found == at->end()) return "";
    at = &*found;
    begin = end + 1;
  }
  return at->is_structured() && !at->is_array() ? "" : at->dump();
}

std::string line_of(const SettingsKey& key, const std::string& value) {
  return fmt::format("{} = {}\n    {}: {}\n", key.name, value.empty() ? "..." : value, key.expected,
                     key.meaning);
}

// Of the profile, or none.
json table_of(const SettingsSource& profile, const char* key) {
  const auto found = profile.values.find(key);
  if (found == profile.values.end()) return json::object();
  if (!found->is_object())
    throw InputError("{}: {}: expected a table, found {}", profile.file, key, found->dump());
  return *found;
}

}  // namespace

std::string profile_keys(const SettingsSource& profile) {
  std::string text =
      "base = ...\n    text: the file of the profile that this one changes, relative to its own folder\n";
  for (const SettingsKey& key : settings_keys<Profile>())
    text += line_of(key, value_of(profile.values, key.name));
  const json defaults = table_of(profile, "defaults");
  const auto search = settings_keys<SearchTable>();
  text +=
      "\n[layers.NAME], [defaults.KIND] or [defaults], of every kind\n"
      "kind = ...\n    text: one of those below\nbelow = ...\n    text: the layer that it is built on\n";
  for (const SettingsKey& key : search) text += line_of(key, value_of(defaults, key.name));
  for (const LayerKind& kind : layer_kinds()) {
    text += fmt::format("\n[layers.NAME] with kind = \"{}\": {}\n", kind.name, kind.meaning);
    const json own = defaults.value(kind.name, json::object());
    for (const SettingsKey& key : kind.described()) {
      const std::string value = value_of(own, key.name);
      text += line_of(key, value.empty() ? value_of(defaults, key.name) : value);
    }
  }
  text += "\nWhat the layers of this profile say themselves, in place of what stands above\n";
  const json layers = table_of(profile, "layers");
  for (const auto& [name, own] : layers.items())
    for (const auto& [key, value] : own.items())
      text += fmt::format("layers.{}.{} = {}\n", name, key, value.dump());
  return text;
}

}  // namespace hbr::inline stages
