// How much memory this process may use.
#pragma once

#include <filesystem>
#include <string>

namespace hbr::inline core {

// "2.1 GB (ulimit -v)": the least of the limits that are set, else what the machine has. The control groups
// are read below `root`/proc and `root`/sys.
std::string memory_limit(const std::filesystem::path& root = "/");

}  // namespace hbr::inline core
