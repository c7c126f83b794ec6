// Which nodes of a graph a make target means.
#pragma once

#include <string>
#include <vector>

#include "pipeline/artifact/graph.h"

namespace hbr::inline artifact {

// The nodes of the goals and all they are made from, as a graph. A goal is a stage ("layer3_n10"), a family
// of stages ("layer3": all layer3_*, where no stage has the name itself), either one of a variation
// ("rho_012/layer3", where what it shares with the experiment counts, too), a variation, or "all". A
// replication >= 0 keeps only that one of the goals' replicated stages, and of the others those that stand on
// no other replication. Throws InputError for a goal or replication that is not there.
Graph selected(const Graph& graph, const std::vector<std::string>& goals, int replication);

// The graph as Graphviz text (families.h): replications are counted.
std::string graph_as_dot(const Graph& graph);

}  // namespace hbr::inline artifact
