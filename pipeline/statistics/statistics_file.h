// statistics.json (table.h), read strictly.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace hbr::inline statistics {

// Throws InputError, "WHERE: quantities.NAME.n: expected ..., found ...", where it is not as described in
// table.h. What is kept as a reference has no curves.
void check_statistics(const nlohmann::json& statistics, const std::string& where);

nlohmann::json read_statistics(const std::filesystem::path& file);

}  // namespace hbr::inline statistics
