// One contract for every container, then the distance archive's rule against a plain second implementation.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>

#include "pipeline/core/random.h"
#include "pipeline/qd/distance_archive.h"
#include "pipeline/qd/grid_archive.h"

namespace hbr {
namespace {

struct Solution {
  std::vector<float> genome, descriptor;
  float fitness;
  std::int64_t id;
  Candidate candidate() const {
    return {genome.data(), static_cast<int>(genome.size()), descriptor.data(), fitness, 0, id, id / 3 - 1};
  }
};

Solution random_solution(Rng& rng, std::int64_t id, int d, float sign) {
  Solution s{{}, {}, sign * rng.uniform(), id};
  for (int i = 0; i < 3 + static_cast<int>(id % 2); ++i) s.genome.push_back(rng.uniform());
  for (int i = 0; i < d; ++i) s.descriptor.push_back(rng.uniform(-0.05f, 1.05f));
  return s;
}

struct Container {
  const char* name;
  std::function<std::unique_ptr<Repertoire>()> make;
};
void PrintTo(const Container& c, std::ostream* out) { *out << c.name; }

class RepertoireContract : public testing::TestWithParam<Container> {};

TEST_P(RepertoireContract, SaysWhatBecameOfACandidate) {
  const auto repertoire = GetParam().make();
  Rng rng(Seed(3));
  int novel = 0, replaced = 0, rejected = 0;
  for (int id = 0; id < 3000; ++id) {
    const Slot before = repertoire->size();
    const Solution s = random_solution(rng, id, 2, -1);
    const Added added = repertoire->add(s.candidate());
    if (added.outcome == Outcome::kRejected) {
      ++rejected;
      EXPECT_EQ(added.slot, kNoSlot);
      EXPECT_EQ(repertoire->size(), before);
      continue;
    }
    added.outcome == Outcome::kNovel ? ++novel : ++replaced;
    EXPECT_EQ(repertoire->size(), before + (added.outcome == Outcome::kNovel));
    const EliteStore& store = repertoire->store();
    EXPECT_EQ(store.id(added.slot), id);
    EXPECT_EQ(store.fitness(added.slot), s.fitness);
    ASSERT_EQ(store.length(added.slot), static_cast<int>(s.genome.size()));
    EXPECT_TRUE(std::equal(s.genome.begin(), s.genome.end(), store.genome(added.slot)));
    for (int g = store.length(added.slot); g < 4; ++g) EXPECT_EQ(store.genome(added.slot)[g], 0);
    EXPECT_TRUE(std::equal(s.descriptor.begin(), s.descriptor.end(), store.descriptor(added.slot)));
  }
  EXPECT_GT(novel, 50);
  EXPECT_GT(replaced, 50);
  EXPECT_GT(rejected, 50);
}

TEST_P(RepertoireContract, NeverTakesACopyAgain) {
  const auto repertoire = GetParam().make();
  Rng rng(Seed(4));
  for (int id = 0; id < 500; ++id) {
    const Solution s = random_solution(rng, id, 2, -1);
    repertoire->add(s.candidate());
    EXPECT_EQ(repertoire->add(s.candidate()).outcome, Outcome::kRejected);
  }
}

TEST_P(RepertoireContract, RestoredItGoesOnAsBefore) {
  const auto whole = GetParam().make(), resumed = GetParam().make();
  Rng rng(Seed(5));
  std::vector<Solution> solutions;
  for (int id = 0; id < 2000; ++id) solutions.push_back(random_solution(rng, id, 2, -1));
  for (int id = 0; id < 1000; ++id) whole->add(solutions[id].candidate());
  resumed->restore(whole->store().in_slot_order());
  for (int id = 1000; id < 2000; ++id) {
    const Added a = whole->add(solutions[id].candidate()), b = resumed->add(solutions[id].candidate());
    ASSERT_EQ(a.outcome, b.outcome);
    ASSERT_EQ(a.slot, b.slot);
  }
  const Elites a = whole->store().in_id_order(), b = resumed->store().in_id_order();
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.parent, b.parent);
  EXPECT_EQ(a.solution, b.solution);
  EXPECT_TRUE(std::is_sorted(a.id.begin(), a.id.end()));
}

INSTANTIATE_TEST_SUITE_P(
    AllContainers, RepertoireContract,
    testing::Values(Container{"distance",
                              [] {
                                return make_distance_archive(4, 2, {0.05f, 0.1f, 15, 0, 1});
                              }},
                    Container{"grid", [] { return std::make_unique<GridArchive>(4, 2, 12, 0.0f, 1.0f); }}),
    [](const auto& instance) { return std::string(instance.param.name); });

// The rule of archive-curiosity written down once more, without any structure.
class PlainArchive {
 public:
  PlainArchive(float l, float eps) : l_(l), eps_(eps) {}
  Outcome add(const Solution& s) {
    std::vector<std::pair<float, int>> near = sorted(s, -1);
    if (near.empty() || near[0].first > l_) return held_.push_back(s), Outcome::kNovel;
    if (held_.size() == 1 || near[1].first < (1 - eps_) * l_) return Outcome::kRejected;
    Solution& other = held_[near[0].second];
    const float q = s.fitness, q0 = other.fitness;
    const float n = mean15(near), n0 = mean15(sorted(other, near[0].second));
    const float sign = q0 > 0 ? 1 : q0 < 0 ? -1 : 0;
    if (q >= (1 - sign * eps_) * q0 && n >= (1 - eps_) * n0 &&
        (q - q0) * std::abs(n0) > -(n - n0) * std::abs(q0))
      return other = s, Outcome::kReplaced;
    return Outcome::kRejected;
  }
  const std::vector<Solution>& held() const { return held_; }

 private:
  std::vector<std::pair<float, int>> sorted(const Solution& s, int excluded) const {
    std::vector<std::pair<float, int>> near;
    for (int i = 0; i < static_cast<int>(held_.size()); ++i) {
      if (i == excluded) continue;
      float d2 = 0;
      for (std::size_t d = 0; d < s.descriptor.size(); ++d)
        d2 += (s.descriptor[d] - held_[i].descriptor[d]) * (s.descriptor[d] - held_[i].descriptor[d]);
      near.emplace_back(std::sqrt(d2), i);
    }
    std::sort(near.begin(), near.end());
    return near;
  }
  static float mean15(const std::vector<std::pair<float, int>>& near) {
    const std::size_t k = std::min<std::size_t>(15, near.size());
    float sum = 0;
    for (std::size_t i = 0; i < k; ++i) sum += near[i].first;
    return sum / static_cast<float>(k);
  }
  float l_, eps_;
  std::vector<Solution> held_;
};

TEST(DistanceArchive, DecidesAsTheRuleSays) {
  for (const int d : {1, 2, 3, 4, 5})
    for (const float sign : {-1.0f, 1.0f, 0.0f}) {
      const float l = d == 1 ? 0.01f : 0.06f * d;
      const auto archive = make_distance_archive(4, d, {l, 0.1f, 15, 0, 1});
      PlainArchive plain(l, 0.1f);
      Rng rng(Seed(6).child(d));
      int replaced = 0;
      for (int id = 0; id < 2500; ++id) {
        const Solution s = random_solution(rng, id, d, sign);
        const Added added = archive->add(s.candidate());
        ASSERT_EQ(added.outcome, plain.add(s)) << "d " << d << ", candidate " << id;
        replaced += added.outcome == Outcome::kReplaced;
      }
      ASSERT_EQ(archive->size(), static_cast<Slot>(plain.held().size()));
      for (Slot i = 0; i < archive->size(); ++i) EXPECT_EQ(archive->store().id(i), plain.held()[i].id);
      // The rule is strict: with equal fitness 0 nothing is ever replaced.
      EXPECT_EQ(replaced > 5, sign != 0) << replaced;
    }
}

// Of two elites as near, the older slot is the one to beat.
TEST(DistanceArchive, ATieGoesToTheLowerSlot) {
  const auto archive = make_distance_archive(4, 2, {0.2f, 0.1f, 1, 0, 1});
  const std::vector<float> genome(4);
  std::int64_t id = 0;
  const auto add = [&](float x, float y, float fitness) {
    const Solution s{genome, {x, y}, fitness, id++};
    return archive->add(s.candidate());
  };
  add(0.625f, 0.5f, -1);
  add(0.25f, 0.5f, -1);
  add(0.625f, 0.703125f, -1);  // neighbours, so that both are little novel
  add(0.25f, 0.703125f, -1);
  ASSERT_EQ(archive->size(), 4);
  const Added added = add(0.4375f, 0.5f, -0.1f);
  EXPECT_EQ(added.outcome, Outcome::kReplaced);
  EXPECT_EQ(added.slot, 0);
}

TEST(DistanceArchive, KeepsItsSpacing) {
  const auto archive = make_distance_archive(4, 2, {0.05f, 0.1f, 15, 0, 1});
  Rng rng(Seed(7));
  for (int id = 0; id < 20000; ++id) archive->add(random_solution(rng, id, 2, -1).candidate());
  const Rows m = archive->store().in_id_order().measures;
  for (int i = 0; i < m.rows(); ++i)
    for (int j = 0; j < i; ++j) EXPECT_GE((m.row(i) - m.row(j)).norm(), 0.9f * 0.05f - 1e-6f);
}

TEST(GridArchive, HoldsTheBestOfEveryCell) {
  GridArchive grid(4, 2, 10, 0, 1);
  Rng rng(Seed(8));
  std::vector<float> best(100, -2);
  for (int id = 0; id < 5000; ++id) {
    const Solution s = random_solution(rng, id, 2, -1);
    grid.add(s.candidate());
    const auto cell = [](float x) { return std::clamp(static_cast<int>(std::floor(x * 10)), 0, 9); };
    float& b = best[10 * cell(s.descriptor[0]) + cell(s.descriptor[1])];
    b = std::max(b, s.fitness);
  }
  ASSERT_EQ(grid.size(), 100);
  std::vector<float> held;
  for (Slot i = 0; i < 100; ++i) held.push_back(grid.store().fitness(i));
  std::sort(held.begin(), held.end());
  std::sort(best.begin(), best.end());
  EXPECT_EQ(held, best);
}

}  // namespace
}  // namespace hbr
