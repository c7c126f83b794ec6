#include "pipeline/qd/search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <mutex>
#include <set>

#include "pipeline/qd/distance_archive.h"
#include "tests/pipeline/qd/containers.h"
#include "tests/pipeline/qd/search_states.h"

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
      batch.uncertainty[i] = 2 * batch.genome(i, 1);
      batch.valid[i] = batch.genome(i, 0) + batch.genome(i, 1) < 1.5f;
    }
  }
};

struct ToySearch {
  PolynomialMutation variation{3, {10, 0.3f}};
  Toy toy;
  std::unique_ptr<Repertoire> repertoire = make_distance_archive(3, 2, {0.05f, 0.1f, 15, 0, 1});
  std::unique_ptr<Selector> selector = std::make_unique<CuriositySelector>();
  SearchSettings settings{60, 50, 7};
  Search search{*repertoire, *selector, variation, toy, settings, Seed(18)};

  ToySearch() = default;
  ToySearch(const ContainerCase& container, const SelectorKind& kind, Credit credit)
      : repertoire(container.make(3, 2)), selector(test_selector(kind)), settings{60, 50, 7, credit} {}
  void to(std::int64_t generation, int threads) {
    Workers workers(threads);
    while (search.generation() < generation) search.step(workers);
  }
};

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
    EXPECT_EQ(elites.uncertainty[i], 2 * elites.solution(i, 1));
    EXPECT_EQ(elites.parent[i] == -1, elites.id[i] < 50);  // the first generation is drawn at random
  }
}

// The first number of every stream that a search hands out, noted by what it is handed to.
struct Numbers {
  void note(Rng rng) {
    const std::lock_guard lock(mutex);
    all.push_back(rng.uniform_double());
  }
  std::mutex mutex;
  std::vector<double> all;
};
struct NotingVariation final : Variation {
  explicit NotingVariation(Numbers& to) : numbers(to) {}
  int genes() const override { return variation.genes(); }
  bool fixed_length() const override { return true; }
  int sample(float* genome, Rng& rng) const override {
    return numbers.note(rng), variation.sample(genome, rng);
  }
  int vary(const float* parent, int length, float* child, Rng& rng) const override {
    return numbers.note(rng), variation.vary(parent, length, child, rng);
  }
  Numbers& numbers;
  PolynomialMutation variation{3, {10, 0.3f}};
};
struct NotingEvaluator final : Evaluator {
  explicit NotingEvaluator(Numbers& to) : numbers(to) {}
  int descriptor_size() const override { return 2; }
  void evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed seed) const override {
    for (Eigen::Index i = begin; i < end; ++i) numbers.note(Rng(seed.child(i)));
    toy.evaluate(batch, begin, end, seed);
  }
  Numbers& numbers;
  Toy toy;
};
// Besides, it is told of the very parent it drew, or of none where that one is gone.
struct NotingSelector final : Selector {
  NotingSelector(Numbers& to, const Repertoire& of) : numbers(to), repertoire(of) {}
  Slot draw(Slot size, Rng& rng) const override {
    numbers.note(rng);
    const Slot slot = static_cast<Slot>(rng.below(size));
    drawn.emplace_back(slot, repertoire.store().id(slot));
    return slot;
  }
  void learn(Slot parent, const Added& child) override {
    if (drawn.empty()) {  // the first generation
      EXPECT_EQ(parent, kNoSlot);
      return;
    }
    const auto [slot, id] = drawn[told++];
    const bool there = repertoire.store().id(slot) == id || slot == child.slot;
    EXPECT_EQ(parent, there ? slot : kNoSlot);
    gone += !there;
  }
  std::vector<std::int64_t> memory() const override { return {}; }
  void restore(const std::vector<std::int64_t>&) override {}
  Numbers& numbers;
  const Repertoire& repertoire;
  mutable std::vector<std::pair<Slot, std::int64_t>> drawn;
  std::size_t told = 0;
  int gone = 0;
};

TEST(Search, EveryGenerationAndChildHasNumbersOfItsOwn) {
  constexpr int kGenerations = 40, kBatch = 25;
  Numbers numbers;
  const NotingVariation variation(numbers);
  const NotingEvaluator evaluator(numbers);
  const auto repertoire = make_distance_archive(3, 2, {0.05f, 0.1f, 15, 0, 1});
  NotingSelector selector(numbers, *repertoire);
  Search search(*repertoire, selector, variation, evaluator, {kGenerations, kBatch, 7}, Seed(19));
  Workers workers(2);
  while (!search.done()) search.step(workers);
  EXPECT_EQ(numbers.all.size(), static_cast<std::size_t>((3 * kGenerations - 1) * kBatch));
  EXPECT_EQ(std::set(numbers.all.begin(), numbers.all.end()).size(), numbers.all.size());
  EXPECT_GT(selector.gone, 0);
}

// Tells whom the search credits, where nobody is ever replaced.
struct CreditNote final : Selector {
  Slot draw(Slot size, Rng& rng) const override {
    drawn.push_back(static_cast<Slot>(rng.below(size)));
    return drawn.back();
  }
  void learn(Slot parent, const Added& child) override {
    credited.push_back(parent);
    born.push_back(child);
  }
  std::vector<std::int64_t> memory() const override { return {}; }
  void restore(const std::vector<std::int64_t>&) override {}
  mutable std::vector<Slot> drawn;
  std::vector<Slot> credited;
  std::vector<Added> born;
};
struct WithoutFitness final : Evaluator {
  int descriptor_size() const override { return 2; }
  void evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed) const override {
    for (Eigen::Index i = begin; i < end; ++i) {
      batch.descriptor.row(i) = batch.genome.row(i).head(2);
      batch.valid[i] = 1;
    }
  }
};

TEST(Search, CreditsTheParentOrAsPublishedThatOfASibling) {
  constexpr int kBatch = 50, kGenerations = 20;
  for (const Credit credit : {Credit::kParent, Credit::kPublished}) {
    const PolynomialMutation variation(3, {10, 0.3f});
    const WithoutFitness evaluator;
    const auto repertoire = make_distance_archive(3, 2, {0.02f, 0.1f, 15, 0, 1});
    CreditNote note;
    Search search(*repertoire, note, variation, evaluator, {kGenerations, kBatch, 7, credit}, Seed(20));
    Workers workers(1);
    while (!search.done()) search.step(workers);
    const Elites elites = repertoire->store().in_id_order();
    int own = 0, bred = 0;
    for (int g = 1; g < kGenerations; ++g) {
      const auto drawn = note.drawn.begin() + (g - 1) * kBatch;
      const auto credited = note.credited.begin() + g * kBatch;
      EXPECT_TRUE(std::is_permutation(drawn, drawn + kBatch, credited));
      for (int i = 0; i < kBatch; ++i) {
        own += drawn[i] == credited[i];
        const Added& child = note.born[g * kBatch + i];
        if (child.admission ==
            Admission::kNovel) {  // bred from the parent that was drawn, whoever is credited
          ++bred;
          EXPECT_EQ(elites.parent[child.slot], elites.id[drawn[i]]);
        }
      }
    }
    EXPECT_GT(bred, 20);
    if (credit == Credit::kParent)
      EXPECT_EQ(own, (kGenerations - 1) * kBatch);
    else
      EXPECT_LT(own, 4 * kGenerations);  // a permutation has one fixed point in the mean
  }
}

class EverySearch : public testing::TestWithParam<std::tuple<ContainerCase, SelectorKind>> {
 protected:
  static std::unique_ptr<ToySearch> make(Credit credit) {
    const auto& [container, selector] = GetParam();
    return std::make_unique<ToySearch>(container, selector, credit);
  }
};

TEST_P(EverySearch, AnyNumberOfThreadsGivesTheSame) {
  const auto one = make(Credit::kParent), three = make(Credit::kParent);
  one->to(60, 1);
  three->to(60, 3);
  expect_same(one->search.state(), three->search.state());
}

TEST_P(EverySearch, ResumedItEndsAsIfItHadNeverStopped) {
  for (const Credit credit : {Credit::kParent, Credit::kPublished}) {
    const auto whole = make(credit), first = make(credit), second = make(credit);
    whole->to(60, 1);
    first->to(23, 1);
    second->search.resume(first->search.state());
    second->to(60, 1);
    expect_same(whole->search.state(), second->search.state());
  }
}

INSTANTIATE_TEST_SUITE_P(AllPairs, EverySearch,
                         testing::Combine(testing::ValuesIn(all_containers()),
                                          testing::ValuesIn(all_selectors())),
                         [](const auto& instance) {
                           return std::get<ContainerCase>(instance.param).name + "_" +
                                  std::get<SelectorKind>(instance.param).name;
                         });

struct Unsound final : Evaluator {
  int descriptor_size() const override { return 2; }
  void evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed) const override {
    for (Eigen::Index i = begin; i < end; ++i) {
      batch.valid[i] = 1;
      batch.descriptor(i, 1) = NAN;
    }
  }
};

// So that no container has to.
TEST(SearchDeathTest, RefusesWhatIsNotFinite) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  const PolynomialMutation variation(3, {10, 0.3f});
  const Unsound evaluator;
  const auto repertoire = make_distance_archive(3, 2, {0.05f, 0.1f, 15, 0, 1});
  UniformSelector selector;
  Search search(*repertoire, selector, variation, evaluator, {3, 10, 1}, Seed(20));
  Workers workers(1);
  EXPECT_DEATH(search.step(workers), "child 0: descriptor or fitness is not finite");
}

}  // namespace
}  // namespace hbr
