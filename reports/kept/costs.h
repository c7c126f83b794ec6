// What the stages of a run cost, by the manifests of their artifacts.
#pragma once

#include <map>
#include <string>

#include "pipeline/artifact/manifest.h"

namespace hbr::inline reports {

struct StageCost {
  int artifacts = 0;
  double seconds = 0, cpu_seconds = 0;  // over all artifacts
  double memory = 0, disk = 0;          // bytes: the most of one artifact's run, of all artifacts
  bool operator==(const StageCost&) const = default;
};

// By stage ("layer1"); all stages of a variation together ("variation rho_012").
std::map<std::string, StageCost> stage_costs(const std::map<std::string, Manifest>& manifests);

StageCost whole_cost(const std::map<std::string, StageCost>& costs);

}  // namespace hbr::inline reports
