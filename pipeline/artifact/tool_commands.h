// The commands of the tool that make artifacts: what its command line gave, and what each does with it.
#pragma once

#include <string>
#include <vector>

#include "pipeline/artifact/freshness.h"
#include "pipeline/artifact/graph.h"
#include "pipeline/artifact/runner.h"

namespace hbr::inline artifact {

struct ToolArguments {
  std::filesystem::path profile;
  std::vector<std::string> goals{"all"};
  int replication = -1;
  int threads = 0;  // 0: the processors, shared among make's jobs
  std::string make = "make";
  int parent = 0;                    // the make that called; 0 for a person
  double group = 0;                  // seconds of stages that are run by one launch
  std::vector<std::string> outputs;  // of `run`
  std::string handover;              // JSON
  std::filesystem::path record;
  Workspace workspace;
  RunOptions run;
};

std::size_t count_stale(const std::vector<Freshness>& freshness);
void say_nothing_to_do(const ToolArguments& arguments, const Graph& graph);
// 0 where each program is to count the processors that it finds where it is launched.
int threads_to_launch_with(const ToolArguments& arguments);

// Becomes make, which runs what of `graph` is not fresh; `all` is the whole profile's. The lock stays with
// it. Returns, with the exit code, only where nothing is to be run.
int make_artifacts(ToolArguments& arguments, const Graph& graph, const Graph& all);

// Runs the stages that one launch was given, here or through the words of LAUNCH; the exit code.
int run_artifacts(ToolArguments& arguments);

}  // namespace hbr::inline artifact
