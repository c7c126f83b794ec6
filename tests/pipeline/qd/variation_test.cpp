#include "pipeline/qd/variation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <vector>

namespace hbr {
namespace {

TEST(PolynomialStep, FollowsItsDistribution) {
  // P(|delta| <= x) = 1 - (1 - x)^(eta + 1), from the density (eta + 1)/2 (1 - |delta|)^eta.
  Rng rng(Seed(15));
  constexpr int kDraws = 200000;
  constexpr float kEta = 10;
  for (const float x : {0.02f, 0.06f, 0.15f, 0.3f}) {
    int within = 0, up = 0;
    for (int i = 0; i < kDraws; ++i) {
      const float step = polynomial_step(0.5f, kEta, rng.uniform()) - 0.5f;
      within += std::abs(step) <= x;
      up += step > 0;
    }
    const double p = 1 - std::pow(1 - x, kEta + 1);
    EXPECT_NEAR(within, kDraws * p, 5 * std::sqrt(kDraws * p * (1 - p)));
    EXPECT_NEAR(up, kDraws / 2, 5 * std::sqrt(kDraws / 4.0));
  }
  EXPECT_EQ(polynomial_step(0.9f, 10, 0.9999999f), 1);  // clipped
  EXPECT_EQ(polynomial_step(0.1f, 10, 0.0f), 0);
  EXPECT_EQ(polynomial_step(0.3f, 10, 0.5f), 0.3f);
}

TEST(PolynomialMutation, ChangesTheStatedShareOfGenes) {
  const PolynomialMutation mutation(8, {10, 0.1f});
  Rng rng(Seed(16));
  std::vector<float> parent(8), child(8);
  EXPECT_EQ(mutation.sample(parent.data(), rng), 8);
  int changed = 0, clones = 0;
  for (int i = 0; i < 50000; ++i) {
    mutation.vary(parent.data(), 8, child.data(), rng);
    int here = 0;
    for (int g = 0; g < 8; ++g) {
      here += child[g] != parent[g];
      EXPECT_TRUE(child[g] >= 0 && child[g] <= 1);
    }
    changed += here;
    clones += here == 0;
  }
  EXPECT_NEAR(changed, 40000, 5 * std::sqrt(400000 * 0.09));
  EXPECT_NEAR(clones / 50000.0, std::pow(0.9, 8), 0.012);  // 43 %
}

// With one gene in ten and three genes: 0.9^3 of the children would be their parents.
TEST(PolynomialMutation, ChangesAtLeastOneGeneWhereItIsTo) {
  Rng rng(Seed(19));
  const std::vector<float> parent{0.4f, 0.5f, 0.6f};
  std::vector<float> child(3);
  const auto changes = [&](MutatedGenes genes) {
    const PolynomialMutation mutation(3, {10, 0.1f, genes});
    std::map<int, int> count;  // children by how many genes differ
    for (int i = 0; i < 20000; ++i) {
      mutation.vary(parent.data(), 3, child.data(), rng);
      int here = 0;
      for (int g = 0; g < 3; ++g) here += child[g] != parent[g];
      ++count[here];
    }
    return count;
  };
  const std::map<int, int> each = changes(MutatedGenes::kEach), least = changes(MutatedGenes::kAtLeastOne),
                           every = changes(MutatedGenes::kEvery);
  EXPECT_NEAR(each.at(0) / 20000.0, 0.729, 0.02);
  EXPECT_FALSE(least.contains(0));
  EXPECT_NEAR(least.at(1) / 20000.0, 0.729 + 3 * 0.1 * 0.81, 0.02);
  EXPECT_NEAR(least.at(2) / 20000.0, 3 * 0.01 * 0.9, 0.01);
  EXPECT_EQ(every.rbegin()->first, 3);
  EXPECT_GT(every.at(3), 19900);  // a step may be smaller than a float tells
}

// Where none mutates by chance, each gene is as likely to be the one.
TEST(PolynomialMutation, DrawsTheOneGeneUniformly) {
  Rng rng(Seed(20));
  const PolynomialMutation mutation(4, {10, 0, MutatedGenes::kAtLeastOne});
  const std::vector<float> parent(4, 0.5f);
  std::vector<float> child(4);
  std::map<int, int> changed;
  for (int i = 0; i < 8000; ++i) {
    mutation.vary(parent.data(), 4, child.data(), rng);
    for (int g = 0; g < 4; ++g)
      if (child[g] != parent[g]) ++changed[g];
  }
  for (int g = 0; g < 4; ++g) EXPECT_NEAR(changed[g], 2000, 200);
}

TEST(BlockMutation, AddsAndRemovesWholeBlocks) {
  const BlockMutation mutation(3, 3, 3, {10, 0.0f},
                               0.05f);  // no gene mutates: what stays must be the parent's
  Rng rng(Seed(17));
  std::map<int, int> sampled;
  std::vector<float> parent(mutation.genes()), child(mutation.genes());
  for (int i = 0; i < 3000; ++i) ++sampled[mutation.sample(parent.data(), rng)];
  ASSERT_EQ(sampled.size(), 3u);
  for (const int length : {6, 9, 12}) EXPECT_NEAR(sampled[length], 1000, 130);

  for (const int length : {6, 9, 12}) {
    for (int g = 0; g < length; ++g) parent[g] = 0.01f * static_cast<float>(g + 1);
    std::map<int, int> lengths, added_at, lost_at;
    for (int i = 0; i < 40000; ++i) {
      const int now = mutation.vary(parent.data(), length, child.data(), rng);
      ++lengths[now];
      const auto differs =
          std::mismatch(child.begin(), child.begin() + std::min(now, length), parent.begin());
      const auto block = static_cast<int>(differs.first - child.begin()) / 3 - 1;
      if (now > length) ++added_at[block];
      if (now < length) ++lost_at[block];
      std::vector<float> kept;  // the child without its new block, the parent without its lost one
      for (int g = 0; g < now; ++g)
        for (int h = 0; h < length; ++h)
          if (child[g] == parent[h]) kept.push_back(child[g]);
      EXPECT_EQ(static_cast<int>(kept.size()), std::min(now, length));
      EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
      EXPECT_TRUE(std::equal(parent.begin(), parent.begin() + 3, child.begin()));
    }
    EXPECT_NEAR(lengths[length + 3], length < 12 ? 1000 : 0, 160);
    EXPECT_NEAR(lengths[length - 3], length > 6 ? 1000 : 0, 160);
    const int blocks = length / 3 - 1;
    for (int b = 0; b <= blocks && length < 12; ++b) EXPECT_NEAR(added_at[b], 1000 / (blocks + 1), 130);
    for (int b = 0; b < blocks && length > 6; ++b) EXPECT_NEAR(lost_at[b], 1000 / blocks, 130);
  }
}

}  // namespace
}  // namespace hbr
