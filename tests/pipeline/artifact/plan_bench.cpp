// Planning as experiments grow: what is not there is found, and the plan is written.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "pipeline/artifact/freshness.h"
#include "pipeline/artifact/plan.h"
#include "pipeline/artifact/temporary.h"

namespace hbr {
namespace {

// Chains of four stages, and one that reads all of their ends.
Graph chains(int artifacts) {
  Graph graph;
  std::vector<std::pair<std::string, std::string>> ends;
  for (int r = 0; r < artifacts / 4; ++r) {
    std::string before;
    for (const char* stage : {"a", "b", "c", "d"}) {
      std::vector<std::pair<std::string, std::string>> inputs;
      if (!before.empty()) inputs.emplace_back("before", before);
      before = fmt::format("{}/{:04}.h5", stage, r);
      graph.push_back({"program", stage, r, before, {{"replication", r}}, inputs, {}});
    }
    ends.emplace_back(fmt::format("end{:04}", r), before);
  }
  graph.push_back({"program", "all", -1, "all.h5", nlohmann::json::object(), ends, {}});
  return graph;
}

// In memory where there is a place for it: ext4 searches long for an inode for seconds after thousands of
// files were deleted, as each benchmark does at its end.
std::filesystem::path fast_folder() {
  const std::filesystem::path memory = "/dev/shm";
  return std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path();
}

void planning(benchmark::State& state) {
  const Temporary folder(temporary_beside(fast_folder() / "planning"));
  std::filesystem::create_directory(folder.path);
  std::ofstream(folder.path / "program") << "a program";
  const Workspace workspace{folder.path / "out", folder.path, folder.path};
  const Graph graph = chains(static_cast<int>(state.range(0)));
  for (auto _ : state) write_plan(workspace.out, graph, freshness_of(workspace, graph), 1, 0);
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(planning)->Arg(1000)->Arg(10000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace hbr
