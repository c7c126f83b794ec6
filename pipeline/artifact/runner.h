// Runs stage programs: one node at a time (called by make), or all that is stale by handing a plan to make.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/artifact/freshness.h"
#include "pipeline/artifact/slice.h"

namespace hbr {

struct RunOptions {
  int threads = 1;      // of one stage program
  std::string launch;   // words before every stage program: "srun -n1"
  std::string version;  // of the repository, for the manifest
};

// Where a stage program is to write, and which it is to be: without these two, it leaves no record and does
// not look.
struct StagePlaces {
  std::filesystem::path output, checkpoint;
  std::filesystem::path record = {};
  std::string program = {};  // sha256
};

// The command line of a node's stage program.
std::vector<std::string> stage_command(const Workspace& workspace, const Node& node,
                                       const RunOptions& options, const StagePlaces& places);

// Makes the node's artifact unless it is fresh. The stage writes to a temporary name in the same folder,
// which becomes the artifact when the program succeeded and left it and the record of its run; then the
// manifest is written. Returns
// the exit code: 0, or 2 where the stage has told what was wrong. Throws InputError for every other failure.
int run_node(const Workspace& workspace, const Node& node, const RunOptions& options);

// Removes what killed runs left in the folders of the graph.
void remove_temporaries(const Workspace& workspace, const Graph& graph);

}  // namespace hbr
