#include "pipeline/artifact/variations.h"

#include <map>

namespace hbr::inline artifact {
namespace {

// What a run's artifact is a function of, apart from where it stands.
std::string identity(const Node& node) {
  return nlohmann::json{{"program", node.program},         {"stage", node.stage},
                        {"replication", node.replication}, {"settings", node.settings},
                        {"inputs", node.inputs},           {"sources", node.sources}}
      .dump();
}

}  // namespace

Graph add_variation(Graph& graph, const std::string& name, Graph varied) {
  std::map<std::string, Node> known;
  for (const Node& node : graph) known.emplace(identity(node), node);
  std::map<std::string, std::string> place;  // of an output of `varied`
  for (Node& node : varied) {
    for (auto& [input, output] : node.inputs) output = place.at(output);
    std::string& output = place[node.output];
    const auto shared = known.find(identity(node));
    if (shared == known.end()) {
      node.variation = name;
      node.output = name + "/" + node.output;
      graph.push_back(node);
    } else {
      node = shared->second;
    }
    output = node.output;
  }
  return varied;
}

}  // namespace hbr::inline artifact
