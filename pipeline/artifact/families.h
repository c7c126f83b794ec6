// The stages of an experiment as a graph that can be read: those that do the same stand in one box.
#pragma once

#include <set>
#include <string>
#include <vector>

namespace hbr::inline artifact {

struct StageBox {
  std::string stage, variation;  // graph.h
  int runs = 0;                  // of it: its replications
  std::set<std::string> needs;   // targets (target_of in graph.h), all of them among the stages
};

struct DotColours {
  std::string line, text, fill;  // as Graphviz names them
};

// Graphviz text, from top to bottom. Stages of one variation are a family, and one box, where they need the
// same families and their names begin or end with the same word: layer2_n1 and layer2_n10, nao_plane and
// industrial_plane. An arrow that others already imply is left out; each variation has a frame.
std::string stages_as_dot(const std::vector<StageBox>& stages, const DotColours& colours);

}  // namespace hbr::inline artifact
