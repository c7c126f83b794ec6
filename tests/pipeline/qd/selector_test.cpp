#include "pipeline/qd/selector.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hbr {
namespace {

// The same life for a curiosity selector and a plain list of scores.
struct PlainLife {
  CuriositySelector selector;
  std::vector<double> scores;
  void lives(int steps, Rng& rng) {
    for (int i = 0; i < steps; ++i) {
      const Slot parent =
          scores.empty() || rng.below(10) == 0 ? kNoSlot : static_cast<Slot>(rng.below(scores.size()));
      const int kind = rng.below(4);
      Added added{Admission::kRejected, kNoSlot};
      if (kind == 0 || scores.empty()) added = {Admission::kNovel, static_cast<Slot>(scores.size())};
      if (kind == 1 && !scores.empty())
        added = {Admission::kReplaced, static_cast<Slot>(rng.below(scores.size()))};
      selector.learn(parent, added);
      if (parent != kNoSlot) scores[parent] += added.admission == Admission::kRejected ? -0.5 : 1;
      if (added.admission == Admission::kNovel) scores.push_back(0);
      if (added.admission == Admission::kReplaced) scores[added.slot] = 0;
    }
  }
};

TEST(CuriositySelector, DrawsInProportionToTheScoreAboveTheLowest) {
  PlainLife life;
  Rng rng(Seed(9));
  life.lives(60, rng);
  const double floor = std::min(0.0, *std::min_element(life.scores.begin(), life.scores.end()));
  double total = 0;
  for (const double s : life.scores) total += s - floor;
  ASSERT_GT(total, 0);
  constexpr int kDraws = 400000;
  std::vector<int> drawn(life.scores.size());
  for (int i = 0; i < kDraws; ++i) ++drawn[life.selector.draw(static_cast<Slot>(drawn.size()), rng)];
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const double p = (life.scores[i] - floor) / total;
    EXPECT_NEAR(drawn[i], kDraws * p, 5 * std::sqrt(kDraws * p * (1 - p)));
  }
}

TEST(CuriositySelector, KeepsTheScoresOfALongLife) {
  PlainLife life;
  Rng rng(Seed(10));
  life.lives(20000, rng);
  const std::vector<std::int64_t> halves = life.selector.memory();
  ASSERT_EQ(halves.size(), life.scores.size());
  for (std::size_t i = 0; i < halves.size(); ++i) EXPECT_EQ(halves[i], 2 * life.scores[i]);
}

}  // namespace
}  // namespace hbr
