// The profiles, what they plan, and what a profile's mistakes read like.
#include <gmock/gmock.h>

#include <fstream>
#include <functional>
#include <map>
#include <set>

#include "pipeline/artifact/freshness.h"
#include "pipeline/artifact/profile.h"
#include "pipeline/core/check.h"
#include "stages/plan/experiment.h"
#include "stages/plan/profile.h"
#include "tests/stages/planned.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

TEST(Profiles, AllThatAreThereCanBePlanned) {
  int profiles = 0;
  fs::current_path(HBR_SOURCE_DIR);  // as hbr does: files that a profile does not name are below it
  for (const auto& entry : fs::directory_iterator(kProfiles)) {
    if (entry.path().extension() != ".toml") continue;  // what is told of them
    SCOPED_TRACE(entry.path());
    const Graph graph = experiment_graph(entry.path());
    EXPECT_NO_THROW(check_graph(graph));
    EXPECT_EQ(settings_from_source<Profile>(read_inheriting(entry.path())).name, entry.path().stem());
    ++profiles;
  }
  EXPECT_GE(profiles, 3);
}

// Without digits no stage asks for a dataset, a network or a robot.
TEST(Profiles, LinesNeedNoDataset) {
  const Graph paper = experiment_graph(kProfiles / "paper.toml"),
              lines = experiment_graph(kProfiles / "lines.toml");
  const auto all = by_output(paper);
  for (const Node& node : lines) {
    if (node.stage == "statistics" || node.stage == "report") continue;
    EXPECT_TRUE(node.sources.empty()) << node.output;
    ASSERT_TRUE(all.contains(node.output)) << node.output;
    EXPECT_EQ(node.settings, all.at(node.output).settings) << node.output;
  }
  EXPECT_FALSE(by_output(lines).contains("dataset.h5"));
  EXPECT_TRUE(by_output(lines).contains("flat_arcs/49.h5"));
}

// Layers evolve on over each other and the robot's points, as searches that are longer than those before; the
// arm goes through the same as its own control.
TEST(Profiles, LayersAreTunedOverEachOther) {
  const auto nodes = by_output(experiment_graph(kProfiles / "paper.toml"));
  const auto inputs = [&](const std::string& output) {
    const auto& list = nodes.at(output).inputs;
    return std::map<std::string, std::string>(list.begin(), list.end());
  };
  for (const std::string robot : {"nao", "nao_left", "industrial", "arm"}) {
    const std::string points = robot == "arm" ? "layer1/03.h5" : robot + "_projected/03.h5",
                      tuned = robot + "_tuned", lines = tuned + "_lines/03.h5", arcs = tuned + "_arcs/03.h5";
    const std::map<std::string, std::pair<const char*, std::int64_t>> searches{
        {"lines", {"layer2_n10/03.h5", 1000}},
        {"arcs", {"layer3_b/03.h5", 1000}},
        {"top", {"layer4/03.h5", 800}},
        {"all", {"layer4/03.h5", 800}}};
    for (const auto& [layer, of] : searches) {
      const auto& [before, generations] = of;
      const std::string output = tuned + "_" + layer + "/03.h5";
      json settings = nodes.at(output).settings, base = nodes.at(before).settings;
      EXPECT_EQ(settings["more"], generations) << layer;
      settings["more"] = 0;
      base["search"]["generations"] = base["search"]["generations"].get<std::int64_t>() + generations;
      EXPECT_EQ(settings, base) << layer << ": otherwise as the arm's layer";
      EXPECT_EQ(inputs(output)["below1"], points);
      EXPECT_EQ(inputs(output)["elites"], before);
      EXPECT_EQ(inputs(output).contains("plane"), robot != "arm");
    }
    EXPECT_FALSE(inputs(tuned + "_lines/03.h5").contains("below2"));
    EXPECT_EQ(inputs(tuned + "_arcs/03.h5")["below2"], lines);
    EXPECT_EQ(inputs(tuned + "_top/03.h5")["below2"], "layer2_n10/03.h5");
    EXPECT_EQ(inputs(tuned + "_top/03.h5")["below3"], "layer3_b/03.h5");
    EXPECT_EQ(inputs(tuned + "_all/03.h5")["below2"], lines);
    EXPECT_EQ(inputs(tuned + "_all/03.h5")["below3"], arcs);
    auto shown = inputs(tuned + "/03.h5");
    EXPECT_EQ(shown["arm1"], "layer1/03.h5");
    EXPECT_EQ(shown["arm4"], "layer4/03.h5");
    EXPECT_EQ(shown["before1"], points);
    EXPECT_EQ(shown["before2"], "layer2_n10/03.h5");
    EXPECT_EQ(shown["after1"], points);
    EXPECT_EQ(shown["after2"], lines);
    EXPECT_EQ(shown["after3"], arcs);
    EXPECT_EQ(shown["top"], tuned + "_top/03.h5");
    EXPECT_EQ(shown["all"], tuned + "_all/03.h5");
  }
}

// "accuracy.layers", "defaults.pencil.framing": what selects a reading is a key of the profile.
TEST(Profiles, EveryOptionOfTheLedgerIsAKey) {
  const json keys =
      settings_to_json(settings_from_source<Profile>(read_inheriting(kProfiles / "paper.toml")));
  const json readings = read_toml(fs::path(HBR_SOURCE_DIR) / "reports/readings.toml").values["readings"];
  int options = 0;
  for (const json& reading : readings) {
    const auto option = reading["option"].get<std::string>();
    if (option.empty()) continue;
    std::string pointer = fmt::format("/{}", option);
    std::replace(pointer.begin(), pointer.end(), '.', '/');
    EXPECT_TRUE(keys.contains(json::json_pointer(pointer))) << reading["id"] << ": " << reading["option"];
    ++options;
  }
  EXPECT_GT(options, 10);
}

// Or MNIST would be taken for it in silence.
TEST(Profiles, ADatasetOfOnesOwnHasAFolderOfItsOwn) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "p.toml";
  const std::string opening = "base = \"" + (kProfiles / "reduced.toml").string() +
                              "\"\nname = \"p\"\ndataset = { name = \"noise\", sha256 = []";
  std::ofstream(file) << opening << " }\n";
  EXPECT_THAT([&] { experiment_graph(file); },
              testing::ThrowsMessage<InputError>(HasSubstr(
                  "p.toml: dataset.folder: '.cache/mnist' is that of 'mnist'; expected another of the "
                  "dataset 'noise'")));
  std::ofstream(file) << opening << ", folder = \"noise\" }\n";
  EXPECT_NO_THROW(experiment_graph(file));
}

// What is wrong with a layer's table is told at its place.
TEST(Layers, AreReadStrictly) {
  const TemporaryFolder folder;
  const auto complaint = [&](const std::string& lines) {
    const fs::path file = folder.path() / "p.toml";
    std::ofstream(file) << "base = \"" << (kProfiles / "lines.toml").string() << "\"\nname = \"p\"\n"
                        << lines;
    try {
      experiment_graph(file);
    } catch (const InputError& error) {
      const std::string text = error.what(), place = folder.path().string() + "/";
      return text.starts_with(place) ? text.substr(place.size()) : text;
    }
    return std::string("no complaint");
  };
  EXPECT_EQ(complaint(""), "no complaint");
  EXPECT_THAT(complaint("layers.other = { kind = \"lines_from_start\", below = \"layer1\" }\n"
                        "accuracy.layers = [\"layer2_n10\", \"reference4d\", \"other\"]"),
              HasSubstr("accuracy.layers has 2 layers of the kind lines_from_start; expected at most one"));
  EXPECT_THAT(complaint("layers.mine.kind = \"line\""),
              HasSubstr("p.toml:3:13: kind 'line' of layer: expected one of points, lines,"));
  EXPECT_THAT(
      complaint("layers.mine.below = \"layer1\""),
      HasSubstr("p.toml:3:8: layer 'mine' says no kind; a layer of your own needs one of points, lines,"));
  EXPECT_THAT(complaint("layers.layer2_n11.samples = 20"),
              HasSubstr("layer 'layer2_n11' says no kind (did you mean 'layer2_n1"));
  EXPECT_THAT(complaint("layers.mine = { kind = \"lines\", samples = 3 }"),
              HasSubstr("p.toml:3:8: layer 'mine' says no layer below, which lines are built on"));
  EXPECT_THAT(complaint("layers.mine = { kind = \"lines\", below = \"layer11\", samples = 3 }"),
              HasSubstr("layer 'mine' is built on 'layer11', which is not there (did you mean 'layer1'?)"));
  EXPECT_THAT(
      complaint("layers.layer1.below = \"layer1_substitute\""),
      HasSubstr("layer 'layer1' is built on 'layer1_substitute', but points move the joints themselves"));
  EXPECT_THAT(
      complaint("layers.layer3_b.below = \"layer1\""),
      HasSubstr("layer 'layer3_b' is of arcs, which command displacements; 'layer1' answers to places"));
  EXPECT_THAT(
      complaint("layers.layer2_n1.sample = 4"),
      HasSubstr("p.toml:3:18: lines have no key 'sample' (did you mean 'samples'?); they have batch,"));
  EXPECT_THAT(complaint("layers.layer2_n1.samples = 0"),
              HasSubstr("p.toml:3:28: samples: expected a whole number from 1 to 100000"));
  EXPECT_THAT(complaint("defaults.arcs.cost = 1"), HasSubstr("p.toml:3:15: arcs have no key 'cost'"));
  EXPECT_THAT(complaint("layers.mine = { kind = \"arcs\", below = \"layer2_n10\", samples = 3 }"),
              HasSubstr("missing key 'controller'"));
  EXPECT_THAT(complaint("layers.a = { kind = \"lines\", below = \"a\", samples = 3 }"),
              HasSubstr("layer 'a' is of lines, which command places; 'a' answers to displacements"));
  EXPECT_THAT(complaint("leave_out = [\"layer2_n10\"]"),
              HasSubstr("layer 'layer2_n10' is left out, but 'layer3_b' is built on it"));
  EXPECT_EQ(complaint("longest_line = 0.2"),
            "p.toml:3:1: 'longest_line' is how profiles were written before; write defaults.longest_line");
  EXPECT_THAT(complaint("[layer2]\nspacing = 0.1"),
              HasSubstr("p.toml:3:2: 'layer2' is how profiles were written"));
  EXPECT_THAT(complaint("leave_out = [\"layer9\"]"), HasSubstr("there is no layer 'layer9'"));
  EXPECT_THAT(complaint("accuracy.layers = [\"layer2_n1\", \"layer3_b\"]"),
              HasSubstr("'layer2_n1' is built on 'layer1', 'layer3_b' on 'layer2_n10'"));
  EXPECT_THAT(complaint("substitution.layer = \"layer2_n1\""),
              HasSubstr("substitution.layer = 'layer2_n1': this layer is of kind lines; expected arcs"));
}

class Variations : public testing::Test {
 protected:
  // lines.toml with fewer replications and these variations.
  fs::path profile(const std::string& variations) const {
    const fs::path path = folder_.path() / "mine.toml";
    std::ofstream(path) << "base = \"" << (kProfiles / "lines.toml").string()
                        << "\"\nname = \"mine\"\nreplications.lines = 2\n"
                        << variations;
    return path;
  }
  Graph graph(const std::string& variations) const { return experiment_graph(profile(variations)); }
  // Without the folder's name.
  std::string complaint(const std::string& variations) const {
    try {
      graph(variations);
    } catch (const InputError& error) {
      const std::string text = error.what(), place = folder_.path().string() + "/";
      return text.starts_with(place) ? text.substr(place.size()) : text;
    }
    return "no complaint";
  }
  static std::string variation(const std::string& name, const std::string& set) {
    return "[[variations]]\nname = \"" + name + "\"\nchanges = \"Something.\"\n" + set + "\n";
  }
  TemporaryFolder folder_;
};

// What a variation runs is what the profile with its keys changed would run.
TEST_F(Variations, AreTheChangedProfileWithoutWhatItShares) {
  const auto varied = by_output(graph(variation("short", "set.defaults.longest_line = 0.1535")));
  const auto plain = by_output(graph("")), changed = by_output(graph("defaults.longest_line = 0.1535\n"));
  // What is told the same and made of what is the same.
  const std::function<bool(const std::string&)> same = [&](const std::string& output) {
    const Node &a = changed.at(output), &b = plain.at(output);
    return a.settings == b.settings && a.inputs == b.inputs &&
           std::ranges::all_of(a.inputs, [&](const auto& input) { return same(input.second); });
  };
  for (const auto& [output, node] : changed) {
    if (node.stage == "statistics" || node.stage == "report") continue;
    const bool shared = same(output);
    EXPECT_EQ(shared, node.stage.starts_with("layer1") || node.program == "searches") << output;
    ASSERT_EQ(varied.contains("short/" + output), !shared) << output;
    const Node& run = varied.at(shared ? output : "short/" + output);
    EXPECT_EQ(run.settings, node.settings) << output;
    EXPECT_EQ(run.stage, node.stage);
    EXPECT_EQ(run.program, node.program);
  }
  for (const auto& [output, node] : plain)
    if (node.stage != "report") {
      EXPECT_EQ(varied.at(output).settings, node.settings) << output;
    }
  const Node& statistics = varied.at("short/statistics.json");
  EXPECT_EQ(statistics.settings["profile"], "mine/short");
  const std::map<std::string, std::string> inputs(statistics.inputs.begin(), statistics.inputs.end());
  EXPECT_EQ(inputs.at("layer1/01.h5"), "layer1/01.h5");
  EXPECT_EQ(inputs.at("layer2_n10/01.h5"), "short/layer2_n10/01.h5");
}

TEST_F(Variations, AllStandInTheReport) {
  const auto nodes =
      by_output(graph(variation("short", "set.defaults.longest_line = 0.1535") +
                      variation("all_genes", "[variations.set.defaults]\nmutation = \"every\"")));
  const Node& page = nodes.at("page");
  const std::map<std::string, std::string> inputs(page.inputs.begin(), page.inputs.end());
  EXPECT_TRUE(inputs.contains("short/statistics.json"));
  EXPECT_TRUE(inputs.contains("all_genes/statistics.json"));
  EXPECT_FALSE(inputs.contains("short/layer2_n10/00.h5"));
  EXPECT_EQ(page.settings["variations"][1]["name"], "all_genes");
  EXPECT_EQ(nodes.at("all_genes/layer1/00.h5").settings["search"]["mutation"], "every");
}

TEST_F(Variations, AreReadAsStrictlyAsTheProfile) {
  EXPECT_EQ(complaint(variation("v", "set.defaults.longest_lin = 0.3")),
            "mine.toml:7:14: defaults.longest_lin is neither a key nor a kind of layers (did you mean "
            "'longest_line'?)");
  EXPECT_THAT(complaint(variation("v", "set.defaults.longest_line = -1")),
              HasSubstr("mine.toml:7:29: longest_line: expected a number from 0.001 to 100"));
  EXPECT_THAT(
      complaint(variation("v", "set.substitution.layer = \"n11\"")),
      HasSubstr("mine.toml: variation 'v': substitution.layer = 'n11': expected the name of a layer ("));
  EXPECT_THAT(complaint(variation("v", "set.name = \"w\"")),
              HasSubstr("mine.toml:7:5: variation 'v' can't change 'name'"));
  EXPECT_THAT(complaint(variation("v", "set = 3")), HasSubstr("variations.0.set: expected a table"));
  EXPECT_THAT(complaint(variation("v", "")), HasSubstr("missing key 'variations.0.set'"));
  EXPECT_THAT(complaint(variation("v", "set.defaults.longest_line = 0.256")), HasSubstr("changes nothing"));
  EXPECT_THAT(complaint(variation("v", "set.judge.bumps = 10")), HasSubstr("changes nothing"));
  EXPECT_THAT(complaint(variation("a b", "set.seed = 1")), HasSubstr("expected letters, digits and _"));
  for (const char* taken : {"layer1", "layer3", "page", "statistics", "all", "test"})
    EXPECT_THAT(complaint(variation(taken, "set.seed = 1")), HasSubstr("stands twice, or is a stage's"));
  EXPECT_THAT(complaint(variation("v", "set.seed = 1") + variation("v", "set.seed = 2")),
              HasSubstr("'v' stands twice"));
}

}  // namespace
}  // namespace hbr
