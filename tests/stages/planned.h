// What a profile plans.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "stages/plan/experiment.h"

namespace hbr {

inline const std::filesystem::path kProfiles = std::filesystem::path(HBR_SOURCE_DIR) / "stages/profiles";

inline std::map<std::string, Node> by_output(const Graph& graph) {
  std::map<std::string, Node> nodes;
  for (const Node& node : graph) nodes.emplace(node.output, node);
  return nodes;
}

}  // namespace hbr
