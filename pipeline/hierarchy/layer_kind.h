// A kind of layer, as a profile names it: its settings, described once, and what is made of them.
#pragma once

#include <span>
#include <string_view>

#include "pipeline/core/settings.h"
#include "pipeline/core/settings_list.h"
#include "pipeline/hierarchy/layer_model.h"

namespace hbr::inline hierarchy {

struct LayerKind {
  const char* name;     // in profiles
  const char* meaning;  // one line
  // What a command to it names, and what it names in its commands to the layer below: a layer stands on those
  // that answer to what it asks. "" where it moves the joints itself.
  const char* answers;
  const char* asks;
  bool learned;  // asks for a learned descriptor in order to be evolved
  // Reads a layer's own settings strictly; canonical.
  nlohmann::json (*checked)(const SettingsSource& settings);
  std::vector<std::string> (*keys)();       // of the settings
  std::vector<SettingsKey> (*described)();  // the same for people
  bool built_on_others() const { return *asks != 0; }
  bool stands_on(const LayerKind& below) const { return std::string_view(asks) == below.answers; }
  // From settings that were checked; `where` leads the errors.
  std::unique_ptr<LayerModel> (*make)(const nlohmann::json& settings, const std::string& where,
                                      const Surroundings& around);
};

template <class Settings, std::unique_ptr<LayerModel> (*kMake)(const Settings&, const Surroundings&)>
constexpr LayerKind layer_kind(const char* name, const char* meaning, const char* answers, const char* asks,
                               bool learned) {
  return {
      name,
      meaning,
      answers,
      asks,
      learned,
      [](const SettingsSource& source) { return settings_to_json(settings_from_source<Settings>(source)); },
      [] {
        std::vector<std::string> keys;
        const nlohmann::json settings = settings_to_json(Settings{});
        for (const auto& [key, value] : settings.items()) keys.push_back(key);
        return keys;
      },
      settings_keys<Settings>,
      [](const nlohmann::json& settings, const std::string& where, const Surroundings& around) {
        return kMake(settings_from_json<Settings>(settings, where), around);
      }};
}

}  // namespace hbr::inline hierarchy
