// JSON read strictly: UTF-8, one value and nothing behind it, no key twice, no number too large for a double,
// not nested without end. What its fields must be is described as in settings.h.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "pipeline/core/settings.h"

namespace hbr::inline artifact {

// `where` leads the error: the file, or what else the text stands in. Throws InputError, one line.
nlohmann::json parse_json(std::string_view text, const std::string& where);
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
