// The runs that are kept in reports/reference are those that today's profiles plan.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "reports/kept/kept_run.h"
#include "stages/plan/experiment.h"
#include "tests/stages/planned.h"

namespace hbr {
namespace {

namespace fs = std::filesystem;

// The outputs that `output` is made from, by all ways, and itself.
std::set<std::string> planned_lineage(const std::map<std::string, Node>& nodes, const std::string& output) {
  std::set<std::string> found;
  std::vector<std::string> waiting{output};
  while (!waiting.empty()) {
    const std::string next = waiting.back();
    waiting.pop_back();
    if (!found.insert(next).second) continue;
    for (const auto& [name, input] : nodes.at(next).inputs) waiting.push_back(input);
  }
  return found;
}

// One line for each artifact of which the profile now plans another, none or one more.
std::string changed_since(const KeptRun& run, const Graph& graph) {
  const std::map<std::string, Node> nodes = by_output(graph);
  std::string changes;
  for (const auto& [output, artifact] : run.artifacts)
    if (!nodes.contains(output))
      changes += output + ": not planned any more\n";
    else if (settings_hash(nodes.at(output).settings) != artifact.settings)
      changes += output + ": told other settings\n";
  for (const std::string& output : planned_lineage(nodes, "page"))
    if (output != "page" && !output.ends_with("statistics.json") && !run.artifacts.contains(output))
      changes += output + ": not made when the run was kept\n";
  return changes;
}

// Whoever changes what a profile plans makes its kept run again (`make all reference figures PROFILE=NAME`):
// README.md, RESULTS.md and the ledger quote it, and would tell of an experiment that nobody can make any
// more.
TEST(KeptSettings, AreThoseOfThePlans) {
  fs::current_path(HBR_SOURCE_DIR);  // files that a profile does not name are below it
  for (const auto& [name, run] : read_all_kept(fs::path(HBR_SOURCE_DIR) / "reports/reference"))
    EXPECT_EQ(changed_since(run, experiment_graph(kProfiles / (run.profile + ".toml"))), "") << name;
}

TEST(KeptSettings, EveryKindOfChangeIsTold) {
  Graph graph(3);
  graph[0].output = "layer1/00.h5";
  graph[0].settings = {{"joints", 8}};
  graph[1].output = "layer2/00.h5";
  graph[1].inputs = {{"below1", "layer1/00.h5"}};
  graph[2].output = "page";
  graph[2].inputs = {{"layer", "layer2/00.h5"}};
  KeptRun run;
  for (const Node& node : {graph[0], graph[1]})
    run.artifacts[node.output] = {"", settings_hash(node.settings)};
  EXPECT_EQ(changed_since(run, graph), "");
  graph[0].settings["joints"] = 9;
  EXPECT_EQ(changed_since(run, graph), "layer1/00.h5: told other settings\n");
  graph[0].settings["joints"] = 8;
  run.artifacts.erase("layer1/00.h5");
  EXPECT_EQ(changed_since(run, graph), "layer1/00.h5: not made when the run was kept\n");
  run.artifacts["layer3/00.h5"] = {};
  EXPECT_EQ(changed_since(run, graph),
            "layer3/00.h5: not planned any more\nlayer1/00.h5: not made when the run was kept\n");
}

}  // namespace
}  // namespace hbr
