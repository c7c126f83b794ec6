// A profile: one TOML file with every number of an experiment, read strictly.
#pragma once

#include <filesystem>

#include "pipeline/core/settings.h"

namespace hbr::inline artifact {

// Throws InputError, "file:line:column: ...", where the file is missing or not TOML (a duplicate key
// included).
SettingsSource read_toml(const std::filesystem::path& file);

// The same where the file may say base = "OTHER.toml" (a path relative to its own folder) and then hold only
// what differs from that file, which may have a base itself. Every value remembers which file it is from. A
// key `name` is not inherited. Throws InputError where a base is no text, is missing or leads back to its own
// file.
SettingsSource read_inheriting(const std::filesystem::path& file);

// `above` laid over `below`: tables are merged key by key; everything else, lists and lists of tables
// included, replaces what stands below.
SettingsSource laid_over(SettingsSource below, const SettingsSource& above);

// The value at a JSON pointer as a source of its own.
SettingsSource part_of(const SettingsSource& source, const std::string& pointer);

// S is described as in settings.h.
template <class S>
S read_profile(const std::filesystem::path& file) {
  return settings_from_source<S>(read_toml(file));
}

}  // namespace hbr::inline artifact
