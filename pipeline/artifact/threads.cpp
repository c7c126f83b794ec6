#include "pipeline/artifact/threads.h"

#include <fmt/format.h>
#include <sched.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "pipeline/process/identity.h"

namespace hbr::inline artifact {
namespace fs = std::filesystem;
namespace {

// A set of more processors than cpu_set_t has counts as all of those.
int affinity() {
  cpu_set_t set;
  return ::sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : CPU_SETSIZE;
}

// "250000 100000" as 2.5; nothing for "max" or no limit.
std::optional<double> quota_of(const fs::path& group) {
  double quota = -1, period = 0;
  if (!(std::ifstream(group / "cpu.max") >> quota >> period)) {
    std::ifstream(group / "cpu.cfs_quota_us") >> quota;
    std::ifstream(group / "cpu.cfs_period_us") >> period;
  }
  if (!(quota > 0) || !(period > 0)) return {};
  return quota / period;
}

// The least of the group's and those above it.
double quota(const fs::path& root) {
  double least = std::numeric_limits<double>::infinity();
  std::ifstream groups(root / "proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    // NUMBER:CONTROLLERS:PATH; no controllers in version 2
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    if (!controllers.empty() && ("," + controllers + ",").find(",cpu,") == std::string::npos) continue;
    const fs::path path = line.substr(second + 1);
    const fs::path mounts = root / "sys/fs/cgroup";
    for (const fs::path& mount : controllers.empty()
                                     ? std::vector<fs::path>{mounts, mounts / "unified"}
                                     : std::vector<fs::path>{mounts / controllers, mounts / "cpu"})
      for (fs::path group = path.relative_path();; group = group.parent_path()) {
        least = std::min(least, quota_of(mount / group).value_or(least));
        if (group.empty()) break;
      }
  }
  return least;
}

int number_in(const char* variable) {
  const char* text = std::getenv(variable);
  return text ? std::atoi(text) : 0;
}

}  // namespace

int processors(const fs::path& root) {
  int found = affinity();
  for (const char* variable : {"SLURM_CPUS_PER_TASK", "SLURM_CPUS_ON_NODE"})
    if (const int given = number_in(variable); given > 0) {
      found = std::min(found, given);
      break;
    }
  return std::max(1, static_cast<int>(std::min<double>(found, quota(root))));
}

int jobs_of_make() {
  const char* flags = std::getenv("MAKEFLAGS");
  if (!flags) return 1;
  std::istringstream words(flags);
  for (std::string word; words >> word && word != "--";)
    if (word.starts_with("-j")) return word.size() == 2 ? 0 : std::atoi(word.c_str() + 2);
  return 1;
}

std::string this_place() {
  const auto text_in = [](const char* variable) {
    const char* text = std::getenv(variable);
    return text ? text : "";
  };
  return fmt::format("{} {} {}", this_host(), text_in("SLURM_JOB_ID"), text_in("SLURM_STEP_ID"));
}

int threads_of_stage(int asked) {
  if (asked > 0) return asked;
  const char* make = std::getenv("HBR_PLACE");
  const int jobs = make && make != this_place() ? 1 : jobs_of_make();
  return jobs == 0 ? 1 : std::max(1, processors() / jobs);
}

}  // namespace hbr::inline artifact
