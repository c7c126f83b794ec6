// A run's statistics beside those of a reference.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "reports/kept/verify.h"

namespace hbr::inline reports {

// As verify.h says, of the run ("") or of a variation: adds to the result what differs and what can't be
// compared, and returns how many quantities and numbers were.
std::size_t compare_statistics(const nlohmann::json& reference, const nlohmann::json& run,
                               const std::string& variation, bool exact, Verification& result);

}  // namespace hbr::inline reports
