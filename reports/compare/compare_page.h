// Two runs side by side as one page, which a browser opens without a network.
#pragma once

#include <string>

#include "reports/compare/compared_run.h"

namespace hbr::inline reports {

// HTML. What differs stands first; the same two runs give the same bytes. A and B are named by their folders,
// as they were given.
std::string compare_page(const ComparedRun& a, const ComparedRun& b);

}  // namespace hbr::inline reports
