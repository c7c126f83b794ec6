#include "pipeline/artifact/variations.h"

#include <gmock/gmock.h>

#include "pipeline/artifact/freshness.h"
#include "pipeline/artifact/manifest.h"
#include "pipeline/artifact/selection.h"
#include "pipeline/artifact/status.h"
#include "pipeline/core/check.h"

namespace hbr {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// points/R -> lines_a/R, lines_b/R -> sum, for two replications.
Graph plan(int points, int a, int b) {
  Graph graph;
  std::vector<std::pair<std::string, std::string>> all;
  for (int r = 0; r < 2; ++r) {
    const std::string end = "/0" + std::to_string(r) + ".h5";
    graph.push_back({"points", "points", r, "points" + end, {{"x", points}}, {}, {"file"}});
    graph.push_back({"lines", "lines_a", r, "lines_a" + end, {{"x", a}}, {{"below", "points" + end}}, {}});
    graph.push_back({"lines", "lines_b", r, "lines_b" + end, {{"x", b}}, {{"below", "points" + end}}, {}});
    all.insert(all.end(), {{"a" + end, "lines_a" + end}, {"b" + end, "lines_b" + end}});
  }
  graph.push_back({"sum", "sum", -1, "sum.h5", nlohmann::json::object(), all, {}});
  return graph;
}

std::vector<std::string> outputs(const Graph& graph) {
  std::vector<std::string> names;
  for (const Node& node : graph) names.push_back(node.output);
  return names;
}

TEST(Variations, ShareWhatTheyDoNotTouch) {
  Graph graph = plan(1, 2, 3);
  const Graph plain = graph, own = add_variation(graph, "more", plan(1, 2, 4));
  ASSERT_EQ(graph.size(), plain.size() + 3);
  EXPECT_THAT(outputs(Graph(graph.begin() + 7, graph.end())),
              ElementsAre("more/lines_b/00.h5", "more/lines_b/01.h5", "more/sum.h5"));
  EXPECT_THAT(outputs(own), ElementsAre("points/00.h5", "lines_a/00.h5", "more/lines_b/00.h5", "points/01.h5",
                                        "lines_a/01.h5", "more/lines_b/01.h5", "more/sum.h5"));
  const Node& line = graph[7];
  EXPECT_EQ(line.stage, "lines_b");  // the seed is a function of it
  EXPECT_EQ(line.variation, "more");
  EXPECT_EQ(target_of(line), "more/lines_b");
  EXPECT_EQ(slice_of(line)["name"], "more/lines_b/00");
  EXPECT_EQ(slice_of(line)["variation"], "more");
  EXPECT_FALSE(slice_of(graph[0]).contains("variation"));
  EXPECT_EQ(line.inputs[0].second, "points/00.h5");
  EXPECT_EQ(graph.back().inputs[0].second, "lines_a/00.h5");  // the input's name stays, its place is another
  EXPECT_EQ(graph.back().inputs[1].first, "b/00.h5");
  EXPECT_EQ(graph.back().inputs[1].second, "more/lines_b/00.h5");
  check_graph(graph);
}

TEST(Variations, WhatStandsOnAChangeIsItsOwn) {
  Graph graph = plan(1, 2, 3);
  add_variation(graph, "other", plan(9, 2, 3));
  EXPECT_EQ(graph.size(), 14u);  // nothing is shared: all stands on the points
  check_graph(graph);
}

TEST(Variations, ShareWithEachOther) {
  Graph graph = plan(1, 2, 3);
  add_variation(graph, "one", plan(9, 2, 3));
  add_variation(graph, "two", plan(9, 2, 4));
  EXPECT_EQ(graph.size(), 14u + 3u);
  EXPECT_EQ(graph.back().inputs[0].second, "one/lines_a/00.h5");
  add_variation(graph, "same", plan(1, 2, 3));
  EXPECT_EQ(graph.size(), 17u);
}

TEST(Variations, SourcesAndProgramsCount) {
  Graph graph = plan(1, 2, 3), varied = plan(1, 2, 3);
  varied[1].program = "other";
  varied[3].sources = {"another"};
  add_variation(graph, "v", varied);
  EXPECT_THAT(
      outputs(Graph(graph.begin() + 7, graph.end())),
      ElementsAre("v/lines_a/00.h5", "v/points/01.h5", "v/lines_a/01.h5", "v/lines_b/01.h5", "v/sum.h5"));
}

class Goals : public testing::Test {
 protected:
  Goals() {
    add_variation(graph_, "more", plan(1, 2, 4));
    add_variation(graph_, "most", plan(9, 2, 3));
  }
  std::vector<std::string> meant(const std::string& goal, int replication = -1) const {
    return outputs(selected(graph_, {goal}, replication));
  }
  Graph graph_ = plan(1, 2, 3);
};

TEST_F(Goals, NameStagesOfVariations) {
  EXPECT_THAT(meant("more/lines_b", 1), ElementsAre("points/01.h5", "more/lines_b/01.h5"));
  EXPECT_THAT(meant("more/lines_a", 1), ElementsAre("points/01.h5", "lines_a/01.h5"));  // shared
  EXPECT_THAT(meant("more/lines", 0), ElementsAre("points/00.h5", "lines_a/00.h5", "more/lines_b/00.h5"));
  EXPECT_THAT(meant("lines", 0), ElementsAre("points/00.h5", "lines_a/00.h5", "lines_b/00.h5"));
  EXPECT_THAT(meant("most/lines", 0),
              ElementsAre("most/points/00.h5", "most/lines_a/00.h5", "most/lines_b/00.h5"));
  EXPECT_EQ(meant("more").size(), 2 + 2 + 3u);  // and what its sum is made of
  EXPECT_EQ(meant("all").size(), graph_.size());
}

TEST_F(Goals, OfOneReplicationLeaveOutWhatIsMadeFromSeveral) {
  EXPECT_THAT(outputs(selected(plan(1, 2, 3), {"all"}, 1)),
              ElementsAre("points/01.h5", "lines_a/01.h5", "lines_b/01.h5"));
  try {
    meant("sum", 1);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("sum is made from several replications"));
  }
}

TEST_F(Goals, ThatAreNoneAreTold) {
  for (const auto& [goal, words] :
       {std::pair{"mor/lines", "no stage 'mor/lines'"}, std::pair{"mosst", "did you mean 'most'?"},
        std::pair{"more/dots", "the variations are: more, most"}})
    try {
      meant(goal);
      ADD_FAILURE() << goal;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(words));
    }
}

TEST_F(Goals, StatusAndGraphTellVariationsApart) {
  const std::string table = status_table(graph_, std::vector<Freshness>(graph_.size()));
  EXPECT_THAT(table, HasSubstr("\nlines_b           0      0        2"));
  EXPECT_THAT(table, HasSubstr("\nmore/lines_b      0      0        2"));
  EXPECT_THAT(table, HasSubstr("\nmost/points       0      0        2"));
  const std::string dot = graph_as_dot(graph_);
  EXPECT_THAT(dot, HasSubstr("subgraph \"cluster_more\""));
  EXPECT_THAT(dot, HasSubstr("[label=\"lines_b\\n\u00d7 2\"]"));           // of the variation, alone
  EXPECT_THAT(dot, HasSubstr("[label=\"lines*\\n2 stages, \u00d7 4\"]"));  // the experiment's
}

}  // namespace
}  // namespace hbr
