// Files of JSON, read as strictly as json_text.h says. What their fields must be is described as in
// settings.h.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "pipeline/core/json_text.h"
#include "pipeline/core/settings.h"

namespace hbr::inline artifact {

// Throws InputError, one line.
nlohmann::json read_json(const std::filesystem::path& file);

// The file as a struct that is described as in settings.h.
template <class S>
S read_json_as(const std::filesystem::path& file) {
  return settings_from_json<S>(read_json(file), file.string());
}

// A seal is the hash of a table's other values, kept in the table as "seal": with it a table that somebody
// edited can be told from what it tells of.
nlohmann::json sealed(nlohmann::json table);
// Takes the seal off. Throws InputError where there is none, or another table was sealed.
nlohmann::json unsealed(nlohmann::json table, const std::string& where);

}  // namespace hbr::inline artifact
