// The ledger of readings as HTML: what the paper leaves open and what we chose.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace hbr::inline reports {

// readings.toml as JSON: an array of {id, title, paper, reading, alternatives, effect, option}. Throws
// InputError where a text is missing; `option` (the profile's key) may be empty.
std::string ledger_html(const nlohmann::json& readings);

}  // namespace hbr::inline reports
