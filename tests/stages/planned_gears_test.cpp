// What a robot's gears make stale.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>

#include "stages/plan/experiment.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

// Friction and play of a joint are asked for by the replay alone: planes and points stay.
TEST(PlannedGears, AreTheDynamicsAlone) {
  const TemporaryFolder folder;
  const auto nodes = [&](const std::string& more) {
    std::ifstream paper(HBR_SOURCE_DIR "/stages/profiles/paper.toml");
    std::ofstream(folder.path() / "paper.toml") << paper.rdbuf() << more;
    std::map<std::string, Node> by_output;
    for (const Node& node : experiment_graph(folder.path() / "paper.toml"))
      by_output.emplace(node.output, node);
    return by_output;
  };
  const auto plain = nodes(""),
             loose =
                 nodes("\n[[robots.gears]]\njoint = \"elbow\"\nviscous = 0.1\ncoulomb = 0\nplay = 0.01\n");
  ASSERT_EQ(plain.size(), loose.size());
  for (const auto& [output, node] : loose)
    EXPECT_EQ(node.settings != plain.at(output).settings, output.starts_with("industrial_dynamics"))
        << output;
  EXPECT_EQ(loose.at("industrial_dynamics/00.h5").settings["gears"][0]["play"], 0.01);
  // Soles are looked at where one is stood on.
  const auto has_meshes = [&](const std::string& output) {
    return std::ranges::any_of(plain.at(output).inputs, [](const auto& in) { return in.first == "meshes"; });
  };
  EXPECT_TRUE(has_meshes("nao_dynamics/00.h5"));
  EXPECT_FALSE(has_meshes("industrial_dynamics/00.h5"));
}

}  // namespace
}  // namespace hbr
