#include "reports/kept/costs.h"

#include <algorithm>

namespace hbr::inline reports {

std::map<std::string, StageCost> stage_costs(const std::map<std::string, Manifest>& manifests) {
  std::map<std::string, StageCost> costs;
  for (const auto& [output, manifest] : manifests) {
    const Slice& slice = manifest.slice;
    StageCost& cost = costs[slice.variation.empty() ? slice.stage : "variation " + slice.variation];
    ++cost.artifacts;
    cost.seconds += manifest.run.value("seconds", 0.0);
    cost.cpu_seconds += manifest.run.value("cpu_seconds", 0.0);
    cost.memory = std::max(cost.memory, manifest.run.value("peak_memory_bytes", 0.0));
    cost.disk += static_cast<double>(manifest.content.bytes);
  }
  return costs;
}

StageCost whole_cost(const std::map<std::string, StageCost>& costs) {
  StageCost whole;
  for (const auto& [stage, cost] : costs) {
    whole.artifacts += cost.artifacts;
    whole.seconds += cost.seconds;
    whole.cpu_seconds += cost.cpu_seconds;
    whole.memory = std::max(whole.memory, cost.memory);
    whole.disk += cost.disk;
  }
  return whole;
}

}  // namespace hbr::inline reports
