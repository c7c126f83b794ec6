#include "pipeline/artifact/group.h"

#include <algorithm>
#include <map>
#include <set>

#include "pipeline/artifact/claim.h"
#include "pipeline/artifact/launch.h"
#include "pipeline/artifact/program.h"
#include "pipeline/artifact/progress.h"
#include "pipeline/artifact/temporary.h"
#include "pipeline/core/check.h"

namespace hbr::inline artifact {
namespace {

struct Candidate {
  Group nodes;
  double seconds = 0;
  bool open = false;            // may take in more
  std::set<std::size_t> needs;  // other groups
};

// Whether the group waits for the other, be it by way of further ones.
bool waits_for(const std::vector<Candidate>& groups, std::size_t group, std::size_t other) {
  std::vector<std::size_t> way{group};
  std::set<std::size_t> seen(way.begin(), way.end());
  while (!way.empty()) {
    const std::size_t at = way.back();
    way.pop_back();
    if (at == other) return true;
    for (const std::size_t next : groups[at].needs)
      if (seen.insert(next).second) way.push_back(next);
  }
  return false;
}

}  // namespace

std::vector<Group> grouped(const Graph& graph, const std::vector<std::size_t>& positions,
                           const std::function<std::optional<double>(const Node&)>& seconds, double most) {
  std::vector<Candidate> groups;
  std::map<std::string, std::size_t> group_of;  // an output's
  for (const std::size_t position : positions) {
    const Node& node = graph[position];
    std::set<std::size_t> needs;
    for (const auto& [name, output] : node.inputs)
      if (const auto made = group_of.find(output); made != group_of.end()) needs.insert(made->second);
    const std::optional<double> own = most > 0 ? seconds(node) : std::nullopt;
    // Nothing needs this node yet, so a circle could only close through what it needs itself.
    const auto taken_in = std::ranges::find_if(needs, [&](std::size_t group) {
      const Node& first = graph[groups[group].nodes.front()];
      return own && groups[group].open && groups[group].seconds + *own <= most &&
             first.replication == node.replication && first.variation == node.variation &&
             std::ranges::none_of(
                 needs, [&](std::size_t need) { return need != group && waits_for(groups, need, group); });
    });
    const std::size_t group = taken_in != needs.end() ? *taken_in : groups.size();
    if (group == groups.size()) groups.push_back({{}, 0, own.has_value(), {}});
    needs.erase(group);
    groups[group].nodes.push_back(position);
    groups[group].seconds += own.value_or(0);
    groups[group].needs.merge(needs);
    group_of[node.output] = group;
  }
  std::vector<Group> all;
  for (Candidate& group : groups) all.push_back(std::move(group.nodes));
  return all;
}

int run_nodes(const Workspace& workspace, const std::vector<Node>& nodes, const RunOptions& options) {
  RunOptions each = options;
  if (options.handover) each.waited_seconds = std::max(0.0, seconds_now() - options.handover->seconds);
  std::set<std::string> failed;  // outputs
  int first = 0;
  for (const Node& node : nodes) {
    if (std::ranges::any_of(node.inputs, [&](const auto& input) { return failed.contains(input.second); })) {
      failed.insert(node.output);
      continue;
    }
    const int code = guarded_main("hbr", [&] { return run_node(workspace, node, each); });
    each.waited_seconds = 0;
    if (code != 0) failed.insert(node.output);
    if (first == 0) first = code;
  }
  return first;
}

int launch_nodes(const Workspace& workspace, const std::vector<Node>& nodes, const RunOptions& options,
                 const std::vector<std::string>& runner) {
  const std::string more = fmt::format("+{}", nodes.size() - 1), name = name_of(nodes.front()) + more;
  MeasuredCosts costs(workspace.out);
  std::optional<Cost> all = Cost{};
  for (const Node& node : nodes) {
    const std::optional<Cost> cost = costs.of(node, options.threads);
    if (!cost) all.reset();
    if (!all) continue;
    all->seconds += cost->seconds;
    all->memory_bytes = std::max(all->memory_bytes, cost->memory_bytes);
  }
  for (Tries tries(name, options.retries);;) {
    const Temporary record_file(
        temporary_beside(workspace.out / ".plan/record", fmt::format("{}", tries.failed())));
    std::vector<std::string> command = runner;
    const Handover handover{options.launch, tries.failures(), seconds_now(), claim_of(workspace.out)};
    command.insert(command.end(), {settings_to_json(handover).dump(), "--record", record_file.path.string()});
    tell_launcher(name, std::max(1, options.threads), request_for(all, tries.failed()));
    const ChildResult child = run_child(launched(options.launch, command));
    const std::optional<RunRecord> record = read_record(record_file.path);
    if (record && record->exit_code != 0) return record->exit_code;  // it has told what was wrong
    const std::string why = failure_of(child, record, options.launch, "hbr");
    if (why.empty()) return 0;
    tries.fail(why, child.stopped);
  }
}

}  // namespace hbr::inline artifact
