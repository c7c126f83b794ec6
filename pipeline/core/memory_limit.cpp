#include "pipeline/core/memory_limit.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <utility>

namespace hbr::inline core {
namespace {

namespace fs = std::filesystem;
using Limit = std::pair<double, std::string>;  // bytes, who sets it

void lower(Limit& limit, double bytes, const char* who) {
  if (bytes < limit.first) limit = {bytes, who};
}

// The group's own limit and those of the groups above it. A file without a number says "max".
void lower_by_groups(Limit& limit, const fs::path& root, const fs::path& group, const char* file) {
  for (fs::path path = group;; path = path.parent_path()) {
    double bytes = 0;
    if (std::ifstream(root / path.relative_path() / file) >> bytes) lower(limit, bytes, "its control group");
    if (!path.has_relative_path()) return;
  }
}

}  // namespace

std::string memory_limit(const fs::path& root) {
  Limit limit{static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE)),
              "the machine's memory"};
  for (const auto& [resource, who] :
       {std::pair{RLIMIT_AS, "ulimit -v"}, std::pair{RLIMIT_DATA, "ulimit -d"}}) {
    rlimit set{};
    if (::getrlimit(resource, &set) == 0 && set.rlim_cur != RLIM_INFINITY)
      lower(limit, static_cast<double>(set.rlim_cur), who);
  }
  std::ifstream groups(root / "proc/self/cgroup");
  // "0::/user.slice", or of version 1 "9:memory:/user.slice"
  for (std::string line; std::getline(groups, line);) {
    const std::size_t kind = line.find(':'), path = line.find(':', kind + 1);
    if (path == std::string::npos) continue;
    const std::string controllers = line.substr(kind + 1, path - kind - 1);
    if (controllers.empty())
      lower_by_groups(limit, root / "sys/fs/cgroup", line.substr(path + 1), "memory.max");
    if (controllers == "memory")
      lower_by_groups(limit, root / "sys/fs/cgroup/memory", line.substr(path + 1), "memory.limit_in_bytes");
  }
  return fmt::format("{:.1f} GB ({})", 1e-9 * limit.first, limit.second);
}

}  // namespace hbr::inline core
