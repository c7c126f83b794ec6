// How much memory this process may use.
#pragma once

#include <string>

namespace hbr {

// "2.1 GB (ulimit -v)": the least of the limits that are set, else what the machine has.
std::string memory_limit();

}  // namespace hbr
