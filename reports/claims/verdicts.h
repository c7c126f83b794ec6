// The claims and their verdicts as HTML.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace hbr {

// Each takes claims.json: an array of {id, statement, place, paper, ours, verdict, indication, reason,
// ...} (reports/claims/claims.h). Throws InputError where an entry is not so.
std::string verdict_tiles(const nlohmann::json& claims);  // how many of each
std::string verdict_badge(const std::string& verdict);    // its sign and name
std::string claims_table(const nlohmann::json& claims);

}  // namespace hbr
