#include "pipeline/artifact/selection.h"

#include <algorithm>
#include <map>
#include <set>

#include "pipeline/artifact/families.h"
#include "pipeline/core/check.h"
#include "pipeline/core/settings.h"

namespace hbr::inline artifact {
namespace {

// In the graph's order, each once.
template <class Name>
std::vector<std::string> names_of(const Graph& graph, Name name) {
  std::vector<std::string> names;
  std::set<std::string> seen;
  for (const Node& node : graph)
    if (seen.insert(name(node)).second) names.push_back(name(node));
  return names;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// The stage of that name, else the family; empty where there is neither.
std::set<std::string> stage_or_family(const std::vector<std::string>& stages, const std::string& goal) {
  if (contains(stages, goal)) return {goal};
  std::set<std::string> family;
  for (const std::string& stage : stages)
    if (stage.starts_with(goal + "_")) family.insert(stage);
  return family;
}

// Some dozens of names: a family of more than two by its name alone.
[[noreturn]] void fail(const std::string& goal, const std::vector<std::string>& stages,
                       const std::vector<std::string>& variations) {
  const auto family_of = [](const std::string& stage) { return stage.substr(0, stage.find('_')); };
  std::map<std::string, int> members;
  for (const std::string& stage : stages) ++members[family_of(stage)];
  std::vector<std::string> names{"all"}, listed;
  for (const std::string& stage : stages) {
    const std::string family = family_of(stage);
    names.insert(names.end(), {stage, family});
    const int size = members[family];
    const std::string entry = size > 2 ? fmt::format("{} ({} stages)", family, size) : stage;
    if (!contains(listed, entry)) listed.push_back(entry);
  }
  names.insert(names.end(), variations.begin(), variations.end());
  const std::string more =
      variations.empty() ? "" : fmt::format("; the variations are: {}", fmt::join(variations, ", "));
  throw InputError("no stage '{}'{}; `make status` lists all; the stages and families are: {}{}", goal,
                   did_you_mean(goal, names), fmt::join(listed, ", "), more);
}

// Targets (graph.h).
std::set<std::string> targets_meant(const Graph& graph, const std::string& goal) {
  std::vector<std::string> variations = names_of(graph, [](const Node& node) { return node.variation; });
  std::erase(variations, "");
  const auto stages_of = [&](const std::string& variation) {
    Graph own;
    std::copy_if(graph.begin(), graph.end(), std::back_inserter(own),
                 [&](const Node& node) { return node.variation == variation; });
    return names_of(own, [](const Node& node) { return node.stage; });
  };
  if (goal == "all") {
    const std::vector<std::string> all = names_of(graph, target_of);
    return {all.begin(), all.end()};
  }

  const std::size_t slash = goal.find('/');
  const std::string head = goal.substr(0, slash);
  const bool varied = contains(variations, head);
  const std::string stage = !varied ? goal : slash == std::string::npos ? "" : goal.substr(slash + 1);
  const std::vector<std::string> plain = stages_of("");
  std::set<std::string> targets;
  if (varied)
    for (const std::string& own : stages_of(head))
      if (stage.empty() || stage_or_family(stages_of(head), stage).contains(own))
        targets.insert(head + "/" + own);
  if (!stage.empty())
    for (const std::string& shared : stage_or_family(plain, stage))
      if (!targets.contains(head + "/" + shared)) targets.insert(shared);
  if (targets.empty()) fail(goal, plain, variations);
  return targets;
}

}  // namespace

Graph selected(const Graph& graph, const std::vector<std::string>& goals, int replication) {
  std::set<std::string> beyond;  // outputs that are, or stand on, another replication than the one asked for
  for (const Node& node : graph) {
    const bool stands_on = std::any_of(node.inputs.begin(), node.inputs.end(),
                                       [&](const auto& input) { return beyond.contains(input.second); });
    if (replication >= 0 && (node.replication >= 0 ? node.replication != replication : stands_on))
      beyond.insert(node.output);
  }
  std::set<std::string> wanted;  // outputs
  for (const std::string& goal : goals) {
    const std::set<std::string> meant = targets_meant(graph, goal);
    int last = -1;
    bool any = false;
    for (const Node& node : graph) {
      if (!meant.contains(target_of(node))) continue;
      last = std::max(last, node.replication);
      if (beyond.contains(node.output)) continue;
      any = true;
      wanted.insert(node.output);
    }
    if (!any && last < 0)
      throw InputError("{} is made from several replications, not from replication {} alone: leave REP out",
                       goal, replication);
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
  std::map<std::string, std::string> target;  // of an output
  std::map<std::string, StageBox> boxes;      // of a target
  for (const Node& node : graph) {
    target[node.output] = target_of(node);
    StageBox& box = boxes[target_of(node)];
    box.stage = node.stage;
    box.variation = node.variation;
    ++box.runs;
    for (const auto& [name, output] : node.inputs) box.needs.insert(target.at(output));
  }
  std::vector<StageBox> stages;
  for (const auto& [name, box] : boxes) stages.push_back(box);
  return stages_as_dot(stages, {"#808080", "#22262b", "#f4f4f0"});
}

}  // namespace hbr::inline artifact
