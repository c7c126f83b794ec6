// The claims as a table of the page.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace hbr::inline reports {

// Takes claims.json (claims.h): a group of rows for each claim, its checks one a row. Throws InputError where
// an entry is not so.
std::string claims_table(const nlohmann::json& claims);

}  // namespace hbr::inline reports
