// Readings taken together, as a profile asks for them.
#include "stages/plan/readings.h"

#include <gmock/gmock.h>

#include <fstream>
#include <map>

#include "pipeline/artifact/selection.h"
#include "pipeline/core/check.h"
#include "stages/plan/experiment.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

class PlannedReadings : public testing::Test {
 protected:
  PlannedReadings() { fs::current_path(HBR_SOURCE_DIR); }
  ~PlannedReadings() override { fs::current_path(before_); }
  Graph graph(const std::string& text) const {
    const fs::path path = folder_.path() / "mine.toml";
    std::ofstream(path) << "base = \"" << HBR_SOURCE_DIR << "/stages/profiles/lines.toml\"\nname = \"mine\"\n"
                        << "replications.lines = 1\n"
                        << text;
    return experiment_graph(path);
  }
  std::string complaint(const std::string& text) const {
    try {
      graph(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no complaint";
  }
  static std::string option(const std::string& id, const std::string& set,
                            const std::string& other = "other") {
    return "[[readings.options]]\nid = \"" + id +
           "\"\nvalues = [{ name = \"plain\", set = {} }, { name = \"" + other + "\", " + set + " }]\n";
  }
  const std::string mutation = option("mutation", "set.defaults.mutation = \"every\""),
                    still = option("still_segments", "set.defaults.still_heading = \"kept\""),
                    flat = option("flat_arcs_start", "set.layers.flat_arcs.start = \"first\"");
  const fs::path before_ = fs::current_path();
  TemporaryFolder folder_;
};

TEST_F(PlannedReadings, AreVariationsByTheirLevelsAndAStage) {
  const Graph all = graph(mutation + still);
  std::map<std::string, const Node*> nodes;
  for (const Node& node : all) nodes[node.output] = &node;
  ASSERT_TRUE(nodes.contains("readings.json"));
  const Node& study = *nodes["readings.json"];
  EXPECT_EQ(study.inputs.size(), 4u);
  EXPECT_EQ(study.settings["readings"][1]["values"], (nlohmann::json{"plain", "other"}));
  EXPECT_EQ(study.settings["runs"][0]["name"], "");
  EXPECT_EQ(study.settings["runs"][3]["name"], "readings_11");
  EXPECT_EQ(study.settings["runs"][3]["levels"], (nlohmann::json{1, 1}));
  for (const auto& [input, output] : study.inputs) EXPECT_TRUE(nodes.contains(output)) << output;

  // Both changes reach the arcs of the last combination; its lines are those of the mutation alone.
  const Node& arcs = *nodes.at("readings_11/layer3_n10/00.h5");
  EXPECT_EQ(arcs.settings["search"]["mutation"], "every");
  EXPECT_EQ(arcs.settings["layer"]["still_heading"], "kept");
  EXPECT_FALSE(nodes.contains("readings_11/layer2_n10/00.h5"));
  EXPECT_TRUE(nodes.contains("readings_10/layer2_n10/00.h5"));
  const std::map<std::string, std::string> below(arcs.inputs.begin(), arcs.inputs.end());
  EXPECT_EQ(below.at("below2"), "readings_10/layer2_n10/00.h5");
  // The page shows what came of it.
  const auto page = std::ranges::find(all, std::string("page"), &Node::output);
  ASSERT_NE(page, all.end());
  EXPECT_THAT(page->inputs, testing::Contains(testing::Pair("readings.json", "readings.json")));
  // `make readings` makes every combination's statistics.
  std::size_t statistics = 0;
  for (const Node& node : selected(all, {"readings"}, -1)) statistics += node.program == "statistics";
  EXPECT_EQ(statistics, 4u);
}

TEST_F(PlannedReadings, MayBeAFractionAndMayNotMeet) {
  const Graph some = graph("readings.combinations = 4\n" + mutation + still + flat);
  std::set<std::string> variations;
  for (const Node& node : some)
    if (!node.variation.empty()) variations.insert(node.variation);
  EXPECT_EQ(variations.size(), 3u);  // beside the plain run
  // What a combination has of others is shared, were it all of it.
  EXPECT_EQ(complaint(still + option("mutation", "set.layers.layer1_substitute.mutation = \"every\"")),
            "no complaint");
}

// A ledger that was edited: the sources stand elsewhere, but for it.
TEST_F(PlannedReadings, OfALedgerThatIsNoneAreRefused) {
  for (const auto& entry : fs::directory_iterator(HBR_SOURCE_DIR))
    if (entry.path().filename() != "reports")
      fs::create_symlink(entry.path(), folder_.path() / entry.path().filename());
  fs::create_directories(folder_.path() / "reports");
  fs::current_path(folder_.path());
  for (const auto& [ledger, told] :
       {std::pair("x = 1", "reports/readings.toml: expected the list of tables 'readings'"),
        {"readings = 3", "reports/readings.toml: expected the list of tables 'readings'"},
        {"readings = [3]", "reports/readings.toml: readings.0: expected a table with the text 'id'"},
        {"[[readings]]\nid = \"mutation\"\n[[readings]]\ntitle = \"x\"",
         "reports/readings.toml: readings.1: expected a table with the text 'id'"}}) {
    std::ofstream(folder_.path() / "reports/readings.toml") << ledger;
    EXPECT_THAT(complaint(mutation), HasSubstr(told));
  }
}

TEST_F(PlannedReadings, AreReadStrictly) {
  EXPECT_THAT(complaint(option("mutations", "set.defaults.mutation = \"every\"")),
              HasSubstr("there is no such reading in reports/readings.toml (did you mean 'mutation'?)"));
  EXPECT_THAT(complaint(mutation + mutation), HasSubstr("'mutation': stands twice"));
  EXPECT_THAT(complaint("[[readings.options]]\nid = \"turns\"\nvalues = [{ name = \"plain\", set = {} }]\n"),
              HasSubstr("1 values; expected 2 to 10"));
  EXPECT_THAT(complaint(option("turns", "set.defaults.turns = \"unsigned\"", "plain")),
              HasSubstr("or that of another"));
  EXPECT_THAT(
      complaint("[[readings.options]]\nid = \"turns\"\nvalues = [{ name = \"a\", set.seed = 1 }, { name = "
                "\"b\", set.seed = 2 }]\n"),
      HasSubstr("the first value sets keys"));
  EXPECT_THAT(complaint(option("turns", "set.defaults.turns = \"signed\"")),
              HasSubstr("'turns': the value 'other' changes nothing"));
  EXPECT_THAT(complaint(option("turns", "set.defaults.turn = \"unsigned\"")),
              HasSubstr("did you mean 'turns'?"));
  EXPECT_THAT(complaint(option("turns", "set.name = \"x\"")), HasSubstr("can't change 'name'"));
  EXPECT_THAT(complaint("[[variations]]\nname = \"readings_1\"\nchanges = \"x\"\nset.seed = 1\n" + mutation),
              HasSubstr("stands twice, or is a stage's"));
}

}  // namespace
}  // namespace hbr
