// Scores that are kept up to date against scores found anew by brute force.
#include "pipeline/qd/local_scores.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "pipeline/core/random.h"
#include "tests/pipeline/qd/solutions.h"

namespace hbr {
namespace {

struct PlainScores {
  float novelty;
  int outperformed;
};
PlainScores plain_scores(const EliteStore& store, Slot of, int k) {
  std::vector<std::pair<float, Slot>> near;
  for (Slot s = 0; s < store.size(); ++s) {
    if (s == of) continue;
    float d2 = 0;
    for (int d = 0; d < store.descriptor_size(); ++d) {
      const float difference = store.descriptor(s)[d] - store.descriptor(of)[d];
      d2 += difference * difference;
    }
    near.emplace_back(d2, s);
  }
  std::sort(near.begin(), near.end());
  near.resize(std::min<std::size_t>(k, near.size()));
  PlainScores scores{0, 0};
  for (const auto& [d2, s] : near) {
    scores.novelty += std::sqrt(d2);
    scores.outperformed += store.fitness(s) < store.fitness(of);
  }
  if (!near.empty()) scores.novelty /= static_cast<float>(near.size());
  return scores;
}

// Places on a coarse raster, so that many are equally far.
Solution on_a_raster(Rng& rng, std::int64_t id, int d) {
  Solution s = random_solution(rng, id, d, -1);
  for (float& x : s.descriptor) x = std::round(x * 16) / 16;
  s.genome.resize(3);
  return s;
}

void agrees_with_brute_force(int d, int k) {
  Rng rng(Seed(26).child(d).child(k));
  EliteStore store(3, d);
  const auto scores = make_local_scores(d, k, 0, 1);
  std::int64_t id = 0;
  std::size_t kept = 0;
  for (int generation = 0; generation < 40; ++generation) {
    std::vector<Slot> replaced;
    for (int i = 0; i < (generation < 20 ? 8 : 1); ++i) store.append(on_a_raster(rng, id++, d).candidate());
    for (int i = 0; i < generation % 7; ++i) {  // new ones and the same one twice, too
      replaced.push_back(static_cast<Slot>(rng.below(store.size())));
      store.replace(replaced.back(), on_a_raster(rng, id++, d).candidate());
    }
    scores->update(store, replaced);
    ASSERT_EQ(static_cast<Slot>(scores->novelty().size()), store.size());
    for (Slot s = 0; s < store.size(); ++s) {
      const PlainScores plain = plain_scores(store, s, k);
      ASSERT_EQ(scores->novelty()[s], plain.novelty) << "d " << d << ", generation " << generation;
      ASSERT_EQ(scores->outperformed()[s], plain.outperformed) << "d " << d << ", generation " << generation;
    }
    EXPECT_TRUE(std::is_sorted(scores->updated().begin(), scores->updated().end()));
    kept += store.size() - scores->updated().size();

    const auto anew = make_local_scores(d, k, 0, 1);  // as after a restart
    anew->update(store, {});
    ASSERT_EQ(anew->novelty(), scores->novelty());
  }
  if (d <= 3) {
    EXPECT_GT(kept, 40u);  // not everything is computed again
  }
}

TEST(LocalScores, AgreeWithBruteForceInAnyDimension) {
  for (const int d : {1, 2, 3, 6, 8})
    for (const int k : {1, 5, 32}) agrees_with_brute_force(d, k);
}

TEST(LocalScores, OfALoneElite) {
  Rng rng(Seed(27));
  EliteStore store(3, 2);
  store.append(on_a_raster(rng, 0, 2).candidate());
  const auto scores = make_local_scores(2, 15, 0, 1);
  scores->update(store, {});
  EXPECT_EQ(scores->novelty(), std::vector<float>{0});
  EXPECT_EQ(scores->outperformed(), std::vector<int>{0});
}

}  // namespace
}  // namespace hbr
