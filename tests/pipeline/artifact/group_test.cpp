// Which stages share a launch.
#include "pipeline/artifact/group.h"

#include <gmock/gmock.h>

#include <map>
#include <numeric>
#include <random>

namespace hbr {
namespace {

using testing::ElementsAre;

Node node(const std::string& output, int replication, const std::vector<std::string>& inputs) {
  Node made;
  made.output = output;
  made.replication = replication;
  for (const std::string& input : inputs) made.inputs.emplace_back(input, input);
  return made;
}

std::vector<std::size_t> all_of(const Graph& graph) {
  std::vector<std::size_t> positions(graph.size());
  std::iota(positions.begin(), positions.end(), 0);
  return positions;
}

std::optional<double> one_second(const Node&) { return 1; }

TEST(Group, TakesWhatDependsOnItWhileTheSecondsLast) {
  const Graph chain{node("a", 0, {}), node("b", 0, {"a"}), node("c", 0, {"b"}), node("d", 0, {"c"})};
  EXPECT_THAT(grouped(chain, all_of(chain), one_second, 3), ElementsAre(Group{0, 1, 2}, Group{3}));
  EXPECT_THAT(grouped(chain, all_of(chain), one_second, 0),
              ElementsAre(Group{0}, Group{1}, Group{2}, Group{3}));
  EXPECT_THAT(grouped(chain, {1, 2}, one_second, 9), ElementsAre(Group{1, 2}));  // the others are fresh
  const auto unknown_b = [](const Node& each) {
    return each.output == "b" ? std::nullopt : std::optional<double>(1);
  };
  EXPECT_THAT(grouped(chain, all_of(chain), unknown_b, 9), ElementsAre(Group{0}, Group{1}, Group{2, 3}));
}

TEST(Group, KeepsReplicationsAndVariationsApart) {
  Graph graph{node("a", 0, {}), node("b", 1, {"a"}), node("c", 0, {"a"}), node("d", 0, {"a"})};
  graph[3].variation = "short";
  EXPECT_THAT(grouped(graph, all_of(graph), one_second, 9), ElementsAre(Group{0, 2}, Group{1}, Group{3}));
  const Graph apart{node("a", 0, {}),
                    node("b", 0, {})};  // neither needs the other: they may run side by side
  EXPECT_THAT(grouped(apart, all_of(apart), one_second, 9), ElementsAre(Group{0}, Group{1}));
}

TEST(Group, ClosesNoCircle) {
  // c needs a directly, and by way of b, which is another replication's.
  const Graph graph{node("a", 0, {}), node("b", 1, {"a"}), node("c", 0, {"a", "b"})};
  EXPECT_THAT(grouped(graph, all_of(graph), one_second, 9), ElementsAre(Group{0}, Group{1}, Group{2}));
}

TEST(Group, OfAnyGraphCanBeMadeOneAfterTheOther) {
  std::mt19937 random(1);  // any choice will do
  for (int round = 0; round < 200; ++round) {
    Graph graph;
    for (int i = 0; i < 30; ++i) {
      std::vector<std::string> inputs;
      for (int k = 0; k < i; ++k)
        if (random() % 8 == 0) inputs.push_back(std::to_string(k));
      graph.push_back(node(std::to_string(i), static_cast<int>(random() % 2), inputs));
    }
    const auto positions = all_of(graph);
    const std::vector<Group> groups = grouped(graph, positions, one_second, 5);
    std::map<std::string, std::size_t> group_of;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      EXPECT_LE(groups[g].size(), 5u);
      for (const std::size_t position : groups[g])
        EXPECT_TRUE(group_of.emplace(graph[position].output, g).second) << "made twice";
    }
    EXPECT_EQ(group_of.size(), graph.size());
    EXPECT_LT(groups.size(), graph.size());
    // As make would: whichever waits for nothing that is not made.
    std::vector<bool> done(groups.size(), false);
    for (std::size_t made = 0, before = 1; made != before;) {
      before = made;
      for (std::size_t g = 0; g < groups.size(); ++g) {
        bool ready = !done[g];
        for (const std::size_t position : groups[g])
          for (const auto& [name, output] : graph[position].inputs)
            ready = ready && (group_of[output] == g || done[group_of[output]]);
        if (ready) done[g] = true, ++made;
      }
    }
    EXPECT_THAT(done, testing::Each(true)) << "round " << round;
  }
}

}  // namespace
}  // namespace hbr
