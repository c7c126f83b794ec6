// Runs stage programs: one node at a time (called by make), or all that is stale by handing a plan to make.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/artifact/freshness.h"
#include "pipeline/artifact/slice.h"
#include "pipeline/core/settings.h"

namespace hbr::inline artifact {

// What a runner that was launched itself is told by the one that launched it.
struct Handover {
  std::string launch;
  std::vector<std::string> failures;  // of the tries before
  double seconds = 0;                 // when it was launched, seconds after 1970
  std::string claim;                  // of the make that wants this (claim.h); "" where there is none
};

template <class Fields>
void describe(Fields& f, Handover& h) {
  f.text("launch", h.launch, "the words that launched it");
  f.texts("failures", h.failures, "why earlier tries failed");
  f.number("seconds", h.seconds, Range{0, 1e12}, "when it was launched");
  f.text("claim", h.claim, "the claim of the make that launched it");
}

struct RunOptions {
  int threads = 1;      // of one stage program; 0: as many as it finds processors where it is launched to
  std::string launch;   // words before every stage program: "srun -n1"
  std::string version;  // of the repository, for the manifest
  int retries = 0;      // how often a failed stage is tried again
  std::optional<Handover> handover = {};
  double waited_seconds = 0;  // of a queue, before this runner was started
  bool counted = false;       // a make counts what is made (tally.h)
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
// manifest is written. Returns the exit code: 0, or 2 where the stage has told what was wrong. Throws
// InputError or StageFailure for every other failure.
int run_node(const Workspace& workspace, const Node& node, const RunOptions& options);

// Removes what killed runs left in the folders of the graph.
void remove_temporaries(const Workspace& workspace, const Graph& graph);

}  // namespace hbr::inline artifact
