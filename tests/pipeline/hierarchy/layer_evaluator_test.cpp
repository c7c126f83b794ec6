// What becomes of genomes that ask for what can't be, and of starts that are common to a search.
#include "pipeline/hierarchy/layer_evaluator.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/pipeline/hierarchy/layers.h"

namespace hbr {
namespace {

using testing::ElementsAre;

// One line to the right, which half of the genomes refuse.
class Hesitant final : public Decoder {
 public:
  int command_size() const override { return 2; }
  int max_commands() const override { return 1; }
  bool relative() const override { return true; }
  int decode(const float* genome, int, double* commands) const override {
    if (genome[0] < 0.5f) return 0;
    commands[0] = 0.1 * genome[1];
    commands[1] = 0;
    return 1;
  }
};

// Where the pen stops; fitness is its distance from the base to the right, in shares of the area.
class Stop final : public SampledOutcome {
 public:
  int descriptor_size() const override { return 2; }
  void describe(const Executions& executions, int first, int n, float* const* descriptor) const override {
    for (int i = 0; i < n; ++i)
      for (int d = 0; d < 2; ++d)
        descriptor[d][i] = executions.points().descriptor(executions.stop(1)[first + i])[d];
  }
  double fitness(const Executions& executions, int execution) const override {
    return executions.points().descriptor(executions.stop(1)[execution])[0];
  }
};

class LayerEvaluators : public Layers {
 protected:
  static constexpr int kSamples = 3;
  const Stack stack = points();
  const Hesitant decoder{};
  const Stop outcome{};
  Executor executor(bool common) const {
    return Executor(stack.points(), stack.layer(0), decoder, kSamples, {}, {nullptr, common});
  }
};

TEST_F(LayerEvaluators, WhatCanNotBeIsNeitherOfferedNorVisited) {
  const Executor some = executor(false);
  const SampledEvaluator evaluator(some, outcome);
  Batch batch(4, 2, 2);
  batch.genome << 0.9f, 0.3f, 0.1f, 0.3f, 0.2f, 0.8f, 0.7f, 0.8f;
  std::fill(batch.valid.begin(), batch.valid.end(), std::uint8_t{1});  // as the batch before left them
  evaluator.evaluate(batch, 0, 4, Seed(1));
  EXPECT_THAT(batch.valid, ElementsAre(1, 0, 0, 1));

  std::vector<Eigen::Index> visited;
  evaluator.visit_executions(batch.genome, 0, 4, Seed(1),
                             [&](const Executions& executions, Eigen::Index row, int first) {
                               visited.push_back(row);
                               EXPECT_GE(executions.stop(1)[first], 0);
                             });
  EXPECT_THAT(visited, ElementsAre(0, 3));
  std::vector<float> mean(4);
  evaluator.mean_fitness(batch.genome, 0, 4, Seed(1), mean.data());
  for (const int i : {0, 3}) EXPECT_TRUE(std::isfinite(mean[i]));
  for (const int i : {1, 2}) EXPECT_TRUE(std::isnan(mean[i]));
}

// Where a search has all its genomes begin at the same places, executions that are to tell what it kept by
// luck begin at others, which differ from genome to genome and from seed to seed.
TEST_F(LayerEvaluators, FreshStartsAreNotTheSearchs) {
  const Rows genomes = Rows::Constant(2, 2, 0.9f);
  const auto starts = [&](const Executor& of, Seed seed) {
    Executions executions;
    std::uint8_t possible[2];
    of.execute(genomes, nullptr, 0, 2, seed, executions, possible);
    std::vector<std::vector<std::int32_t>> all;
    for (int i = 0; i < 2; ++i)
      all.emplace_back(executions.stop(0) + i * of.repeats(), executions.stop(0) + (i + 1) * of.repeats());
    return all;
  };
  const Executor common = executor(true), fresh = common.fresh(5);
  const auto searched = starts(common, Seed(1)), one = starts(fresh, Seed(1)), other = starts(fresh, Seed(2));
  EXPECT_EQ(searched[0], searched[1]);
  EXPECT_EQ(searched, starts(common, Seed(2)));
  EXPECT_EQ(one[0].size(), 5u);
  std::set<std::vector<std::int32_t>> sets{searched[0], {one[0].begin(), one[0].begin() + kSamples}};
  EXPECT_EQ(sets.size(), 2u);
  EXPECT_NE(one[0], one[1]);
  EXPECT_NE(one[0], other[0]);
}

}  // namespace
}  // namespace hbr
