// A profile: one TOML file with every number of an experiment, read strictly.
#pragma once

#include <filesystem>

#include "pipeline/artifact/settings.h"

namespace hbr {

// Throws InputError, "file:line:column: ...", where the file is missing or not TOML (a duplicate key
// included).
SettingsSource read_toml(const std::filesystem::path& file);

// S is described as in settings.h.
template <class S>
S read_profile(const std::filesystem::path& file) {
  return settings_from_source<S>(read_toml(file));
}

}  // namespace hbr
