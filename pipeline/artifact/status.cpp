#include "pipeline/artifact/status.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace hbr::inline artifact {
namespace {

struct Row {
  std::string stage;
  int fresh = 0, stale = 0, missing = 0;
  std::vector<std::pair<std::string, std::vector<int>>> reasons;  // why -> replications, in order
};

std::vector<Row> rows_of(const Graph& graph, const std::vector<Freshness>& freshness) {
  std::vector<Row> rows;
  std::map<std::string, std::size_t> place;
  for (std::size_t i = 0; i < graph.size(); ++i) {
    const auto [found, added] = place.emplace(target_of(graph[i]), rows.size());
    if (added) rows.push_back({found->first, 0, 0, 0, {}});
    Row& row = rows[found->second];
    const Freshness& node = freshness[i];
    (node.state == State::fresh ? row.fresh : node.state == State::missing ? row.missing : row.stale)++;
    if (node.state == State::fresh) continue;
    auto reason = std::find_if(row.reasons.begin(), row.reasons.end(),
                               [&](const auto& each) { return each.first == node.why; });
    if (reason == row.reasons.end()) reason = row.reasons.insert(reason, {node.why, {}});
    reason->second.push_back(graph[i].replication);
  }
  return rows;
}

// "0-3, 7: "; nothing for a stage without replications.
std::string ranges(const std::vector<int>& numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t last = i;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    if (numbers[i] >= 0) {
      text += fmt::format("{}{}", text.empty() ? "" : ", ", numbers[i]);
      if (last > i) text += fmt::format("-{}", numbers[last]);
    }
    i = last + 1;
  }
  return text.empty() ? "" : text + ": ";
}

std::string why(const Row& row) {
  std::vector<std::string> texts;
  for (const auto& [reason, replications] : row.reasons) texts.push_back(ranges(replications) + reason);
  constexpr std::size_t kShown = 3;
  const std::size_t all = texts.size();
  if (all > kShown) texts.resize(kShown);
  return fmt::format("{}{}", fmt::join(texts, "; "),
                     all > kShown ? fmt::format("; and {} more", all - kShown) : "");
}

}  // namespace

std::string status_table(const Graph& graph, const std::vector<Freshness>& freshness) {
  const std::vector<Row> rows = rows_of(graph, freshness);
  std::size_t width = 5;
  for (const Row& row : rows) width = std::max(width, row.stage.size());
  std::string text = fmt::format("{:{}}  fresh  stale  missing  why\n", "stage", width);
  for (const Row& row : rows) {
    std::string line = fmt::format("{:{}}  {:5}  {:5}  {:7}  {}", row.stage, width, row.fresh, row.stale,
                                   row.missing, why(row));
    line.resize(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

Audit audit(const Workspace& workspace, const Graph& graph) {
  Audit found;
  int missing = 0;
  std::uint64_t bytes = 0;
  for (const Node& node : graph) {
    const Found artifact = look_at(workspace, node, Compare::by_content);
    const std::string place = (workspace.out / node.output).string();
    found.read += artifact.bytes.has_value();
    bytes += artifact.bytes.value_or(0);
    if (artifact.state == State::missing)
      ++missing;
    else if (artifact.state != State::fresh)
      found.problems.push_back(fmt::format("{}: {}; make makes it again", place, artifact.why));
  }
  found.summary = fmt::format(
      "{}: {} artifacts read again ({:.1f} MB), {} missing, {} not as they should be{}",
      workspace.out.string(), found.read, 1e-6 * static_cast<double>(bytes), missing, found.problems.size(),
      found.read == 0 ? "; is this OUT a folder of this PROFILE's artifacts?" : "");
  return found;
}

}  // namespace hbr::inline artifact
