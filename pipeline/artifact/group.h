// Several stages run by one launch: a cluster takes longer to start a job than many a stage takes.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/artifact/runner.h"

namespace hbr::inline artifact {

// Positions in a graph, in its order.
using Group = std::vector<std::size_t>;

// Puts each node of the positions given into one group, alone or with stages of its replication that it
// depends on, as long as the seconds of a group add up to at most `most`; a node whose seconds are not known
// stays alone. No two groups wait for each other.
std::vector<Group> grouped(const Graph& graph, const std::vector<std::size_t>& positions,
                           const std::function<std::optional<double>(const Node&)>& seconds, double most);

// Makes the nodes one after the other, what depends on a failed one left out. Tells what went wrong; returns
// the exit code of the first that failed.
int run_nodes(const Workspace& workspace, const std::vector<Node>& nodes, const RunOptions& options);

// The same by one launch of `runner`, a command that ends in run_nodes: it is handed what describes the
// launch (Handover) and the file for its record as its last words.
int launch_nodes(const Workspace& workspace, const std::vector<Node>& nodes, const RunOptions& options,
                 const std::vector<std::string>& runner);

}  // namespace hbr::inline artifact
