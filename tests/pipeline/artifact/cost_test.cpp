// What is asked of a cluster.
#include "pipeline/artifact/cost.h"

#include <gtest/gtest.h>

#include <fstream>

#include "pipeline/artifact/manifest.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

Node layer(int replication, int generations) {
  Node node;
  node.program = node.stage = "layer1";
  node.replication = replication;
  node.output = "layer1/0" + std::to_string(replication) + ".h5";
  node.settings = {{"generations", generations}, {"replication", replication}};
  return node;
}

TEST(Cost, IsTheMostOfTheSameStageWithTheSameSettings) {
  const TemporaryFolder out;
  const auto ran = [&](const Node& node, const nlohmann::json& facts) {
    Manifest manifest;
    manifest.made_from.slice = slice_of(node);
    manifest.key = manifest.made_from.key();
    manifest.run = facts;
    std::filesystem::create_directories(manifest_path(out.path(), node).parent_path());
    write_manifest(manifest_path(out.path(), node), manifest);
  };
  const auto cost = [&](const Node& node, int threads) {
    return MeasuredCosts(out.path()).of(node, threads);
  };
  EXPECT_FALSE(cost(layer(0, 10), 1));
  ran(layer(0, 10), {{"seconds", 4}, {"cpu_seconds", 12}, {"peak_memory_bytes", 3e6}});
  ran(layer(1, 10), {{"seconds", 6}, {"cpu_seconds", 6}, {"peak_memory_bytes", 2e6}});
  ran(layer(2, 99), {{"seconds", 600}, {"cpu_seconds", 600}, {"peak_memory_bytes", 2e9}});
  Node other = layer(3, 10);
  other.stage = "layer1_substitute";
  ran(other, {{"seconds", 900}, {"cpu_seconds", 900}, {"peak_memory_bytes", 9e9}});
  EXPECT_EQ(cost(layer(4, 10), 4)->seconds, 6);
  EXPECT_EQ(cost(layer(4, 10), 1)->seconds, 12);  // on one thread the first would have needed them all
  EXPECT_EQ(cost(layer(4, 10), 1)->memory_bytes, 3e6);
  EXPECT_EQ(cost(layer(4, 99), 1)->seconds, 600);
  EXPECT_FALSE(cost(layer(4, 98), 1));
  std::ofstream(out.path() / "layer1/05.json") << "{";  // damaged: it tells nothing
  EXPECT_EQ(cost(layer(4, 10), 4)->seconds, 6);
}

TEST(Request, HasAMarginAndGrowsWithFailures) {
  EXPECT_EQ(request_for(Cost{10, 100 * 1048576.0}, 0).seconds, 150);
  EXPECT_EQ(request_for(Cost{10, 100 * 1048576.0}, 0).memory_mb, 350);
  EXPECT_EQ(request_for(Cost{10, 100 * 1048576.0}, 2).memory_mb, 1400);
  EXPECT_EQ(request_for({}, 0).seconds, 6 * 3600);
  EXPECT_EQ(request_for({}, 1).memory_mb, 8000);
}

}  // namespace
}  // namespace hbr
