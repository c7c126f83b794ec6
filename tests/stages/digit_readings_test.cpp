// What other readings of the digits plan, one at a time and together.
#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "tests/stages/planned.h"

namespace hbr {
namespace {

// A variation of a reading reaches the stages that draw by it, and no layer below.
TEST(Profiles, ReadingsOfTheDigits) {
  const Graph graph = experiment_graph(kProfiles / "digits_readings.toml");
  const auto nodes = by_output(graph);
  const std::map<std::string, std::set<std::string>> touched{{"workspace", {"layer4", "flat_digits"}},
                                                             {"joints", {"flat_digits"}},
                                                             {"straight_arm", {"flat_digits"}},
                                                             {"axes", {"layer4"}},
                                                             {"reject", {"layer4"}}};
  std::map<std::string, std::set<std::string>> run;
  for (const Node& node : graph)
    if (!node.variation.empty() && node.stage != "statistics" && node.stage != "digit_verdicts" &&
        node.stage != "surest_digits" && node.stage != "digit_turns")
      run[node.variation].insert(node.stage);
  EXPECT_EQ(run, touched);
  for (const auto& [output, pen, start] :
       {std::tuple("flat_digits/02.h5", "straight", "first"),
        std::tuple("joints/flat_digits/02.h5", "joints", "first"),
        std::tuple("straight_arm/flat_digits/02.h5", "straight", "straight_arm")}) {
    EXPECT_EQ(nodes.at(output).settings.at("layer")["pen"], pen);
    EXPECT_EQ(nodes.at(output).settings.at("layer")["start"], start);
  }
  EXPECT_EQ(nodes.at("layer4/00.h5").settings.at("layer")["out_of_range"], "radius");
  EXPECT_EQ(nodes.at("axes/layer4/00.h5").settings.at("layer")["out_of_range"], "axes");
  EXPECT_EQ(nodes.at("reject/layer4/00.h5").settings.at("layer")["out_of_range"], "reject");
  EXPECT_EQ(nodes.at("workspace/layer4/00.h5").settings.at("layer")["pencil"]["framing"], "workspace");
}

// A reading of the network trains another one, and makes what it places; the scale of its space only what it
// places.
TEST(Profiles, ReadingsOfTheNetwork) {
  const Graph graph = experiment_graph(kProfiles / "networks.toml");
  const auto nodes = by_output(graph);
  std::map<std::string, std::set<std::string>> made;
  for (const Node& node : graph)
    if (!node.variation.empty() && (node.stage == "autoencoder" || node.settings.contains("layer")))
      made[node.variation].insert(node.stage);
  const std::set<std::string> placed{"layer4", "flat_digits"},
      trained{"autoencoder", "layer4", "flat_digits"};
  const std::map<std::string, std::set<std::string>> expected{{"linear", trained},
                                                              {"tanh", trained},
                                                              {"rectifier", trained},
                                                              {"every_epoch", trained},
                                                              {"scaled", placed}};
  EXPECT_EQ(made, expected);
  const auto plain = nodes.at("autoencoder/04.h5").settings;
  const auto tanh = nodes.at("tanh/autoencoder/04.h5").settings;
  EXPECT_EQ(plain.at("hidden"), "leaky");
  EXPECT_EQ(tanh.at("hidden"), "tanh");
}

// A line's way-points concern arcs and digits, and through them the robot's; lines themselves start anywhere.
TEST(Profiles, WayPointsOfAnOpenLoop) {
  std::set<std::string> made;
  for (const Node& node : experiment_graph(kProfiles / "drawing.toml"))
    if (node.variation == "open_loop" && node.settings.contains("layer")) made.insert(node.stage);
  for (const char* stage : {"layer3_b", "layer4", "nao_tuned_all"})
    EXPECT_TRUE(made.contains(stage)) << stage;
  for (const char* stage : {"layer1", "layer2_n10", "nao_layer1", "flat_digits"})
    EXPECT_FALSE(made.contains(stage)) << stage;
}

// A reading of the digits reaches the stages that draw by it, and no layer below; what combinations share is
// made once.
TEST(Profiles, ReadingsOfTheDigitsTogether) {
  std::filesystem::current_path(HBR_SOURCE_DIR);  // as hbr does: the ledger of readings is below it
  const Graph graph = experiment_graph(kProfiles / "digits_together.toml");
  const auto nodes = by_output(graph);
  std::map<std::string, std::set<nlohmann::json>> made;
  for (const Node& node : graph)
    if (node.output.starts_with("readings_") && node.settings.contains("layer"))
      made[node.stage].insert(node.settings.at("layer"));
  EXPECT_EQ(made["layer4"].size(), 2 * 3 - 1u);  // framings and ranges, but for the plain one
  EXPECT_EQ(made["flat_digits"].size(), 2 * 2 * 2 - 1u);
  for (const char* below : {"autoencoder", "layer1", "layer2_n10", "layer3_b"})
    EXPECT_FALSE(made.contains(below)) << below;
  // Of each combination (framing, range, pen, start) one digit.
  const auto& digits = nodes.at("layer4/00.h5").settings.at("layer");
  EXPECT_EQ(digits["out_of_range"], "radius");
  EXPECT_EQ(digits["pencil"]["framing"], "box");
  const auto flat = nodes.at("readings_1011/flat_digits/00.h5").settings.at("layer");
  EXPECT_EQ(flat["pencil"]["framing"], "workspace");
  EXPECT_EQ(flat["pen"], "joints");
  EXPECT_EQ(flat["start"], "straight_arm");
}

}  // namespace
}  // namespace hbr
