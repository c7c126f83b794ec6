#include "pipeline/artifact/cost.h"

#include <algorithm>
#include <cmath>

#include "pipeline/artifact/manifest.h"
#include "pipeline/core/check.h"

namespace hbr::inline artifact {
namespace fs = std::filesystem;
namespace {

nlohmann::json without_replication(nlohmann::json settings) {
  settings.erase("replication");
  return settings;
}

}  // namespace

const std::vector<MeasuredCosts::Run>& MeasuredCosts::runs_in(const fs::path& folder) {
  const auto [found, added] = known_.try_emplace(folder);
  if (!added || !fs::is_directory(folder)) return found->second;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".json" || !entry.is_regular_file()) continue;
    try {
      const Manifest manifest = read_manifest(entry.path());
      found->second.push_back({manifest.slice.stage, without_replication(manifest.slice.settings),
                               manifest.run.value("seconds", 0.0), manifest.run.value("cpu_seconds", 0.0),
                               manifest.run.value("peak_memory_bytes", 0.0)});
    } catch (const InputError&) {  // it tells nothing, then
    }
  }
  return found->second;
}

std::optional<Cost> MeasuredCosts::of(const Node& node, int threads) {
  std::optional<Cost> most;
  const nlohmann::json settings = without_replication(node.settings);
  for (const Run& run : runs_in((out_ / node.output).parent_path())) {
    if (run.stage != node.stage || run.settings != settings) continue;
    if (!most) most.emplace();
    most->seconds = std::max({most->seconds, run.seconds, run.cpu_seconds / std::max(1, threads)});
    most->memory_bytes = std::max(most->memory_bytes, run.memory_bytes);
  }
  return most;
}

Request request_for(const std::optional<Cost>& cost, int failed_tries) {
  const double more = std::pow(2, failed_tries);
  if (!cost) return {std::lround(21600 * more), std::lround(4000 * more)};
  return {std::lround(std::ceil(more * (3 * cost->seconds + 120))),
          std::lround(std::ceil(more * (1.5 * cost->memory_bytes / 1048576 + 200)))};
}

}  // namespace hbr::inline artifact
