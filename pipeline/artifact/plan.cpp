#include "pipeline/artifact/plan.h"

#include <fmt/ranges.h>

#include <map>
#include <set>

#include "pipeline/artifact/cost.h"
#include "pipeline/artifact/group.h"
#include "pipeline/artifact/slice.h"

namespace hbr::inline artifact {
namespace fs = std::filesystem;
namespace {

// A phony target for each group, called as its first node. The order of making is all that make decides; the
// recipe finds the rest in its environment.
std::string plan_for_make(const Graph& graph, const std::vector<Group>& groups) {
  std::map<std::string, std::string> target;  // of an output
  for (const Group& group : groups)
    for (const std::size_t node : group) target[graph[node].output] = graph[group.front()].output;
  std::string rules, all;
  for (const Group& group : groups) {
    const std::string& own = graph[group.front()].output;
    std::set<std::string> before;
    std::vector<std::string> outputs;
    for (const std::size_t node : group) {
      outputs.push_back(graph[node].output);
      for (const auto& [name, output] : graph[node].inputs)
        if (const auto made = target.find(output); made != target.end() && made->second != own)
          before.insert(made->second);
    }
    all += " \\\n  " + own;
    rules += fmt::format("\n{}: {}\n\t@exec \"$$HBR_TOOL\" run {}\n", own, fmt::join(before, " "),
                         fmt::join(outputs, " "));
  }
  return fmt::format(
      "# Written by hbr make: what is not as the profile says, and in which order to make it.\n"
      "all:{}\n.PHONY: all{}\n{}",
      all, all, rules);
}

}  // namespace

fs::path plan_path(const fs::path& out) { return out / ".plan/plan.mk"; }

std::size_t write_plan(const fs::path& out, const Graph& graph, const std::vector<Freshness>& freshness,
                       int threads, double group_seconds) {
  std::vector<std::size_t> positions;
  for (std::size_t i = 0; i < graph.size(); ++i) {
    if (freshness[i].state == State::fresh) continue;
    positions.push_back(i);
    write_slice(out, graph[i]);
  }
  MeasuredCosts costs(out);
  const auto seconds = [&](const Node& node) -> std::optional<double> {
    const std::optional<Cost> cost = costs.of(node, threads);
    return cost ? std::optional(cost->seconds) : std::nullopt;
  };
  const std::vector<Group> groups = grouped(graph, positions, seconds, group_seconds);
  write_whole(plan_path(out), plan_for_make(graph, groups));
  return groups.size();
}

}  // namespace hbr::inline artifact
