// What was measured beside what was asked, as a chart of one line.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace hbr::inline reports {

// An inline SVG of a check of claims.json (claims.h) that could be made: the range that counts as reproduced,
// around it the one that counts in part, and a mark where x lies. Ratios far apart stand on a logarithmic
// axis; a range without an end reaches the edge.
std::string range_chart(const nlohmann::json& check);

}  // namespace hbr::inline reports
