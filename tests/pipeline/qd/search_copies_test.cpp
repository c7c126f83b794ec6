// Children that are copies of their parents.
#include <gtest/gtest.h>

#include <atomic>

#include "pipeline/qd/search.h"
#include "tests/pipeline/qd/containers.h"
#include "tests/pipeline/qd/search_states.h"

namespace hbr {
namespace {

// A toy without noise, which counts what it evaluates and may say that it repeats itself.
struct CountingToy final : Evaluator {
  CountingToy(bool says_so, std::atomic<long>& count) : deterministic_(says_so), evaluated(count) {}
  int descriptor_size() const override { return 2; }
  bool deterministic() const override { return deterministic_; }
  void evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed) const override {
    evaluated += end - begin;
    for (Eigen::Index i = begin; i < end; ++i) {
      batch.descriptor.row(i) = batch.genome.row(i).head(2);
      batch.fitness[i] = -batch.genome(i, 2);
      batch.uncertainty[i] = 2 * batch.genome(i, 1);
      batch.valid[i] = batch.genome(i, 0) + batch.genome(i, 1) < 1.5f;
    }
  }
  bool deterministic_;
  std::atomic<long>& evaluated;
};

// One search of a counting toy, so many children of so few parents that copies meet siblings in their
// parent's place.
struct CountingSearch {
  CountingSearch(const ContainerCase& container, Credit credit, bool says_so)
      : toy(says_so, evaluated),
        repertoire(container.make(3, 2)),
        search(*repertoire, selector, variation, toy, {30, 1000, 7, credit}, Seed(19)) {}
  std::atomic<long> evaluated = 0;
  CountingToy toy;
  PolynomialMutation variation{3, {10, 0.2f}};
  std::unique_ptr<Repertoire> repertoire;
  CuriositySelector selector;
  Search search;
};

TEST(Search, ACopyOfADeterministicSolutionNeedsNoEvaluation) {
  Workers workers(2);
  for (const ContainerCase& container : all_containers())
    for (const Credit credit : {Credit::kParent, Credit::kPublished}) {
      CountingSearch all(container, credit, false), fresh(container, credit, true);
      while (!all.search.done()) {
        all.search.step(workers);
        fresh.search.step(workers);
        // Every generation: a copy that enters may be replaced soon.
        const SearchState a = all.search.state(), b = fresh.search.state();
        expect_same(a, b);
        ASSERT_EQ(a.elites.uncertainty, b.elites.uncertainty);
      }
      EXPECT_EQ(all.evaluated, 30 * 1000);
      // Half of the children mutate in no gene, and some genes at a border stay there.
      EXPECT_LT(fresh.evaluated, 1000 + 29 * 1000 * (1 - 0.8 * 0.8 * 0.8) + 500);
      EXPECT_GT(fresh.evaluated, 0.3 * 30 * 1000);
    }
}

}  // namespace
}  // namespace hbr
