// What every selector promises: draws in proportion to weights that are written down here once more.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "pipeline/qd/distance_archive.h"
#include "pipeline/qd/score_selectors.h"
#include "tests/pipeline/qd/containers.h"
#include "tests/pipeline/qd/solutions.h"

namespace hbr {
namespace {

// A search's life as a selector sees it, and the curiosity scores of its elites.
struct Life {
  explicit Life(const SelectorKind& kind) : selector(test_selector(kind)) {}

  void generations(int n) {
    for (int g = 0; g < n; ++g) {
      for (int i = 0; i < 20; ++i) {
        const Slot size = repertoire->size();
        const Slot parent = size == 0 || rng.below(10) == 0 ? kNoSlot : static_cast<Slot>(rng.below(size));
        Solution s = random_solution(rng, id++, 2, -1);
        s.fitness = std::round(8 * s.fitness) / 8;  // so that some are alike
        const Added added = repertoire->add(s.candidate());
        selector->learn(parent, added);
        const bool kept = added.admission != Admission::kRejected;
        if (parent != kNoSlot && parent != added.slot) curiosity[parent] += kept ? 1 : -0.5;
        if (added.admission == Admission::kNovel) curiosity.push_back(0);
        if (added.admission == Admission::kReplaced) curiosity[added.slot] = 0;
      }
      selector->refresh(repertoire->store());
    }
  }
  std::vector<Slot> draws(int n, Seed seed) const {
    Rng from(seed);
    std::vector<Slot> drawn;
    for (int i = 0; i < n; ++i) drawn.push_back(selector->draw(repertoire->size(), from));
    return drawn;
  }

  std::unique_ptr<Repertoire> repertoire =
      make_distance_archive(4, 2, {0.11f, 0.1f, 15, 0, 1, Contest::kFitness});
  std::unique_ptr<Selector> selector;
  std::vector<double> curiosity;
  Rng rng{Seed(28)};
  std::int64_t id = 0;
};

std::vector<double> above_the_lowest(std::vector<double> scores) {
  const double floor = std::min(0.0, *std::min_element(scores.begin(), scores.end()));
  for (double& s : scores) s -= floor;
  return scores;
}

std::vector<double> fitness_of(const EliteStore& store) {
  std::vector<double> values;
  for (Slot s = 0; s < store.size(); ++s) values.push_back(store.fitness(s));
  return values;
}

struct Scores {
  std::vector<double> novelty, outperformed;
};
Scores local_scores(const EliteStore& store) {
  Scores scores;
  for (Slot s = 0; s < store.size(); ++s) {
    std::vector<std::pair<float, Slot>> near;
    for (Slot n = 0; n < store.size(); ++n)
      if (n != s) near.emplace_back(plain_distance(store.descriptor(n), store.descriptor(s), 2), n);
    std::sort(near.begin(), near.end());
    double sum = 0, beaten = 0;
    for (int i = 0; i < kTestNeighbours; ++i) {
      sum += near[i].first;
      beaten += store.fitness(near[i].second) < store.fitness(s);
    }
    scores.novelty.push_back(static_cast<double>(static_cast<float>(sum) / kTestNeighbours));
    scores.outperformed.push_back(beaten);
  }
  return scores;
}

// Pareto fronts by peeling them off one after the other.
std::vector<int> plain_fronts(const Scores& scores) {
  const std::size_t n = scores.novelty.size();
  std::vector<int> front(n, -1);
  const auto dominates = [&](std::size_t a, std::size_t b) {
    return scores.novelty[a] >= scores.novelty[b] && scores.outperformed[a] >= scores.outperformed[b] &&
           (scores.novelty[a] > scores.novelty[b] || scores.outperformed[a] > scores.outperformed[b]);
  };
  for (int now = 0; std::count(front.begin(), front.end(), -1) > 0; ++now) {
    std::vector<std::size_t> members;
    for (std::size_t a = 0; a < n; ++a) {
      bool dominated = front[a] >= 0;
      for (std::size_t b = 0; b < n && !dominated; ++b) dominated = front[b] < 0 && dominates(b, a);
      if (!dominated) members.push_back(a);
    }
    for (const std::size_t m : members) front[m] = now;
  }
  return front;
}

// What each elite's draws should be in proportion to.
std::vector<double> weights(const std::string& selector, const Life& life) {
  const EliteStore& store = life.repertoire->store();
  if (selector == "curiosity") return above_the_lowest(life.curiosity);
  if (selector == "fitness") return above_the_lowest(fitness_of(store));
  if (selector == "novelty") return above_the_lowest(local_scores(store).novelty);
  std::vector<double> weight(store.size(), 1);
  if (selector == "nslc") {  // drawn first against none in a better front, or second against a worse one
    const std::vector<int> front = plain_fronts(local_scores(store));
    for (std::size_t s = 0; s < weight.size(); ++s)
      weight[s] = static_cast<double>(
          std::count_if(front.begin(), front.end(), [&](int other) { return other >= front[s]; }) +
          std::count_if(front.begin(), front.end(), [&](int other) { return other > front[s]; }));
  } else if (selector != "uniform") {
    ADD_FAILURE() << "the weights of selector " << selector << " are not written down here";
  }
  return weight;
}

class SelectorContract : public testing::TestWithParam<SelectorKind> {};

TEST_P(SelectorContract, DrawsInProportionToItsWeights) {
  Life life(GetParam());
  for (int part = 0; part < 3; ++part) {
    life.generations(part < 2 ? 3 : 60);
    std::vector<double> expected = weights(GetParam().name, life);
    const double total = std::accumulate(expected.begin(), expected.end(), 0.0);
    constexpr int kDraws = 200000;
    std::vector<int> drawn(expected.size());
    for (const Slot s : life.draws(kDraws, Seed(29).child(part))) ++drawn.at(s);
    double chi2 = 0;
    int free = -1;
    for (std::size_t s = 0; s < drawn.size(); ++s) {
      const double mean = kDraws * expected[s] / total;
      if (mean == 0) {
        EXPECT_EQ(drawn[s], 0);
        continue;
      }
      chi2 += (drawn[s] - mean) * (drawn[s] - mean) / mean;
      ++free;
    }
    EXPECT_GT(free, 20);
    EXPECT_LT(chi2, free + 4.5 * std::sqrt(2.0 * free)) << part;
  }
}

TEST_P(SelectorContract, RestoredItDrawsTheSame) {
  Life whole(GetParam()), resumed(GetParam());
  whole.generations(12);
  resumed.repertoire->restore(whole.repertoire->store().in_slot_order());
  resumed.selector->restore(whole.selector->memory());
  resumed.curiosity = whole.curiosity;
  resumed.rng = whole.rng;
  resumed.id = whole.id;
  resumed.selector->refresh(resumed.repertoire->store());
  for (int generation = 0; generation < 15; ++generation) {
    ASSERT_EQ(whole.draws(300, Seed(30)), resumed.draws(300, Seed(30))) << generation;
    whole.generations(1);
    resumed.generations(1);
  }
  EXPECT_EQ(whole.selector->memory(), resumed.selector->memory());
}

TEST_P(SelectorContract, OfOneEliteDrawsThatOne) {
  const auto repertoire = make_distance_archive(4, 2, {0.11f, 0.1f, 15, 0, 1});
  const auto selector = test_selector(GetParam());
  Rng rng(Seed(31));
  selector->learn(kNoSlot, repertoire->add(random_solution(rng, 0, 2, -1).candidate()));
  selector->refresh(repertoire->store());
  for (int i = 0; i < 20; ++i) EXPECT_EQ(selector->draw(1, rng), 0);
}

// Elites that nothing tells apart: corners of a square, all as fit.
TEST_P(SelectorContract, DrawsEqualsAlike) {
  const auto repertoire = make_distance_archive(4, 2, {0.11f, 0.1f, 15, 0, 1});
  const auto selector = test_selector(GetParam());
  Rng rng(Seed(32));
  for (int i = 0; i < 4; ++i) {
    Solution s = random_solution(rng, i, 2, -1);
    s.fitness = -0.3f;
    s.descriptor = {i % 2 ? 0.25f : 0.75f, i / 2 ? 0.25f : 0.75f};
    selector->learn(kNoSlot, repertoire->add(s.candidate()));
  }
  ASSERT_EQ(repertoire->size(), 4);
  selector->refresh(repertoire->store());
  std::vector<int> drawn(4);
  for (int i = 0; i < 40000; ++i) ++drawn[selector->draw(4, rng)];
  for (const int n : drawn) EXPECT_NEAR(n, 10000, 5 * 87);
}

// On a raster many elites are as novel, and some outperform as many besides.
TEST(NslcSelector, FrontsAreThosePeeledOffOneByOne) {
  Rng rng(Seed(35));
  EliteStore store(4, 2);
  const auto scores = make_local_scores(2, kTestNeighbours, 0, 1);
  NslcSelector selector(make_local_scores(2, kTestNeighbours, 0, 1));
  const auto on_a_raster = [&](std::int64_t id) {
    Solution s = random_solution(rng, id, 2, -1);
    for (float& x : s.descriptor) x = std::round(x * 8) / 8;
    return s;
  };
  for (int id = 0; id < 300; ++id) {
    if (id % 3 == 2) {
      const auto slot = static_cast<Slot>(rng.below(store.size()));
      store.replace(slot, on_a_raster(id).candidate());
      selector.learn(kNoSlot, {Admission::kReplaced, slot});
      scores->update(store, {slot});
    } else {
      selector.learn(kNoSlot, {Admission::kNovel, store.append(on_a_raster(id).candidate())});
      scores->update(store, {});
    }
    selector.refresh(store);
    ASSERT_EQ(selector.front(),
              plain_fronts({{scores->novelty().begin(), scores->novelty().end()},
                            {scores->outperformed().begin(), scores->outperformed().end()}}))
        << id;
  }
}

INSTANTIATE_TEST_SUITE_P(AllSelectors, SelectorContract, testing::ValuesIn(all_selectors()),
                         [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace
}  // namespace hbr
