// The stage graph of an experiment: what `plan` cuts a profile into.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace hbr::inline artifact {

// One run of a stage program. Its slice is {stage, name, settings, inputs, output}, and the variation where
// it is of one (variations.h).
struct Node {
  std::string program;      // "layer1": the program build/.../bin/layer1
  std::string stage;        // "layer2_n10": the make target that builds all its replications
  int replication = -1;     // -1 for a stage that has none
  std::string output;       // below OUT: "layer2_n10/03.h5", "report" for a folder
  nlohmann::json settings;  // only what this run depends on
  std::vector<std::pair<std::string, std::string>> inputs;  // name in the program -> another node's output
  std::vector<std::string> sources;  // files of the user or the repository it reads (absolute or below the
                                     // repository); their content is part of the key
  std::string variation = {};        // whose run it is; "" for the experiment's own
  // Files that would be among the sources were they there; `missing` lists them, and nothing else minds.
  std::vector<std::string> wished = {};
};

// What make calls the node's stage: "layer2_n10", "VARIATION/layer2_n10".
inline std::string target_of(const Node& node) {
  return node.variation.empty() ? node.stage : node.variation + "/" + node.stage;
}

// In an order in which every input stands before its user. Checked by the planner: unique outputs, known
// inputs, no circle.
using Graph = std::vector<Node>;

}  // namespace hbr::inline artifact
