#include "pipeline/qd/search.h"

#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/qd/distance_archive.h"

namespace hbr {
namespace {

// Two genes are the descriptor; the third costs, and noise from the seed moves the descriptor a little.
class Toy final : public Evaluator {
 public:
  int descriptor_size() const override { return 2; }
  void evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed seed) const override {
    for (Eigen::Index i = begin; i < end; ++i) {
      Rng rng(seed.child(i));
      batch.descriptor.row(i) = batch.genome.row(i).head(2);
      batch.descriptor(i, 0) += 0.001f * rng.uniform();
      batch.fitness[i] = -batch.genome(i, 2);
      batch.valid[i] = batch.genome(i, 0) + batch.genome(i, 1) < 1.5f;
    }
  }
};

struct ToySearch {
  PolynomialMutation variation{3, 10, 0.3f};
  Toy toy;
  DistanceArchiveSettings archive{0.05f, 0.1f, 15, 0, 1};
  std::unique_ptr<Repertoire> repertoire = make_distance_archive(3, 2, archive);
  CuriositySelector selector;
  SearchSettings settings{60, 50, 7};
  Search search{*repertoire, selector, variation, toy, settings, Seed(18)};
  void to(std::int64_t generation, int threads) {
    Workers workers(threads);
    while (search.generation() < generation) search.step(workers);
  }
};

void expect_same(const SearchState& a, const SearchState& b) {
  EXPECT_EQ(a.elites.id, b.elites.id);
  EXPECT_EQ(a.elites.parent, b.elites.parent);
  EXPECT_EQ(a.elites.solution, b.elites.solution);
  EXPECT_EQ(a.elites.measures, b.elites.measures);
  EXPECT_EQ(a.elites.objective, b.elites.objective);
  EXPECT_EQ(a.selector, b.selector);
  ASSERT_EQ(a.progress.size(), b.progress.size());
  for (std::size_t i = 0; i < a.progress.size(); ++i) {
    EXPECT_EQ(a.progress[i].generation, b.progress[i].generation);
    EXPECT_EQ(a.progress[i].mean, b.progress[i].mean);
  }
}

TEST(Search, FillsTheSpaceAndImproves) {
  ToySearch run;
  run.to(60, 1);
  const auto& rows = run.search.progress();
  ASSERT_EQ(rows.size(), 9u);  // 7, 14, ..., 56 and the last
  EXPECT_EQ(rows.back().generation, 60);
  EXPECT_EQ(rows.back().evaluations, 3000);
  EXPECT_EQ(rows.back().size, run.repertoire->size());
  EXPECT_GT(rows.back().size, 150);
  EXPECT_GT(rows.back().mean, rows.front().mean);
  const Elites elites = run.repertoire->store().in_id_order();
  EXPECT_FLOAT_EQ(static_cast<float>(rows.back().mean), elites.objective.mean());
  EXPECT_EQ(static_cast<float>(rows.back().best), elites.objective.maxCoeff());
  for (Eigen::Index i = 0; i < elites.size(); ++i) {
    EXPECT_LT(elites.solution(i, 0) + elites.solution(i, 1), 1.5f);  // nothing invalid is kept
    EXPECT_LT(elites.parent[i], elites.id[i]);
    EXPECT_EQ(elites.parent[i] == -1, elites.id[i] < 50);  // the first generation is drawn at random
  }
}

TEST(Search, AnyNumberOfThreadsGivesTheSame) {
  ToySearch one, three;
  one.to(60, 1);
  three.to(60, 3);
  expect_same(one.search.state(), three.search.state());
}

TEST(Search, ResumedItEndsAsIfItHadNeverStopped) {
  ToySearch whole, first, second;
  whole.to(60, 1);
  first.to(23, 1);
  second.search.resume(first.search.state());
  second.to(60, 1);
  expect_same(whole.search.state(), second.search.state());
}

}  // namespace
}  // namespace hbr
