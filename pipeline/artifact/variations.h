// Variations: the same experiment with a few settings changed, which shares with the plain one, and with the
// variations before it, every run that these settings do not touch.
#pragma once

#include <string>

#include "pipeline/artifact/graph.h"

namespace hbr::inline artifact {

// Appends to `graph` what of `varied` it has not: a node whose program, stage, replication, settings, sources
// and (found so themselves) inputs are another's is that one. What is appended keeps the name of its stage,
// and so its random numbers, and has its output below the folder NAME. Returns the nodes of `varied` with the
// outputs and inputs that they have in `graph`.
Graph add_variation(Graph& graph, const std::string& name, Graph varied);

}  // namespace hbr::inline artifact
