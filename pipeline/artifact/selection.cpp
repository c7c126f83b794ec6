#include "pipeline/artifact/selection.h"

#include <algorithm>
#include <map>
#include <set>

#include "pipeline/artifact/settings.h"
#include "pipeline/core/check.h"

namespace hbr {
namespace {

// The stages in the graph's order.
std::vector<std::string> stages_of(const Graph& graph) {
  std::vector<std::string> stages;
  std::set<std::string> seen;
  for (const Node& node : graph)
    if (seen.insert(node.stage).second) stages.push_back(node.stage);
  return stages;
}

std::set<std::string> stages_meant(const std::vector<std::string>& stages, const std::string& goal) {
  if (goal == "all") return {stages.begin(), stages.end()};
  if (std::find(stages.begin(), stages.end(), goal) != stages.end()) return {goal};
  std::set<std::string> family;
  for (const std::string& stage : stages)
    if (stage.starts_with(goal + "_")) family.insert(stage);
  if (family.empty()) {
    std::vector<std::string> names = stages;
    for (const std::string& stage : stages) names.push_back(stage.substr(0, stage.find('_')));
    throw InputError("no stage '{}'{}; the stages are: {}", goal, did_you_mean(goal, names),
                     fmt::join(stages, ", "));
  }
  return family;
}

}  // namespace

Graph selected(const Graph& graph, const std::vector<std::string>& goals, int replication) {
  const std::vector<std::string> stages = stages_of(graph);
  std::set<std::string> wanted;  // outputs
  for (const std::string& goal : goals) {
    const std::set<std::string> meant = stages_meant(stages, goal);
    int last = -1;
    bool any = false;
    for (const Node& node : graph) {
      if (!meant.contains(node.stage)) continue;
      last = std::max(last, node.replication);
      if (replication >= 0 && node.replication >= 0 && node.replication != replication) continue;
      any = true;
      wanted.insert(node.output);
    }
    if (!any) throw InputError("{} has no replication {}: they go from 0 to {}", goal, replication, last);
  }
  for (auto node = graph.rbegin(); node != graph.rend(); ++node)
    if (wanted.contains(node->output))
      for (const auto& [name, output] : node->inputs) wanted.insert(output);
  Graph found;
  std::copy_if(graph.begin(), graph.end(), std::back_inserter(found),
               [&](const Node& node) { return wanted.contains(node.output); });
  return found;
}

std::string graph_as_dot(const Graph& graph) {
  std::map<std::string, std::string> stage_of;  // output -> stage
  std::map<std::string, int> count;
  std::set<std::pair<std::string, std::string>> arrows;
  for (const Node& node : graph) {
    stage_of[node.output] = node.stage;
    ++count[node.stage];
    for (const auto& [name, output] : node.inputs) arrows.emplace(stage_of.at(output), node.stage);
  }
  std::string dot =
      "digraph experiment {\n"
      "  rankdir=LR; bgcolor=transparent;\n"
      "  node [shape=box, style=\"rounded,filled\", fillcolor=\"#f4f4f0\", fontname=\"sans-serif\", "
      "fontsize=11];\n"
      "  edge [color=\"#808080\", arrowsize=0.6];\n";
  for (const std::string& stage : stages_of(graph)) {
    const std::string times = count[stage] > 1 ? fmt::format("\\n\u00d7 {}", count[stage]) : "";
    dot += fmt::format("  \"{}\" [label=\"{}{}\"];\n", stage, stage, times);
  }
  for (const auto& [from, to] : arrows) dot += fmt::format("  \"{}\" -> \"{}\";\n", from, to);
  return dot + "}\n";
}

}  // namespace hbr
