// Verdicts as HTML.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace hbr::inline reports {

// Of claims.json (reports/claims/claims.h). All throw InputError where a verdict is none of the five.
nlohmann::json claims_decided_by(const std::string& what,
                                 const nlohmann::json& claims);  // "result", "design" or "ours"
std::string verdict_tiles(const nlohmann::json& claims);  // how many of each, of those that a result decides
std::string verdict_filters(const nlohmann::json& claims);  // buttons that show those of one verdict alone

// Of one verdict: its sign and name, `whose` leads the error; and its CSS class.
std::string verdict_badge(const std::string& verdict, const std::string& whose);
std::string verdict_class(const std::string& verdict);

}  // namespace hbr::inline reports
