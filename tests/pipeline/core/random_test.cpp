#include "pipeline/core/random.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace hbr {
namespace {

TEST(Random, PhiloxMatchesTheKnownAnswer) {
  // Random123's kat_vectors: philox4x32-10, counter and key all zero.
  Rng rng{Seed(0)};
  EXPECT_EQ(rng.bits(), 0x6627e8d5u);
  EXPECT_EQ(rng.bits(), 0xe169c58du);
  EXPECT_EQ(rng.bits(), 0xbc57ac4cu);
  EXPECT_EQ(rng.bits(), 0x9b00dbd8u);
}

TEST(Random, EveryBitOfASeedCounts) {
  std::set<std::uint32_t> first = {Rng(Seed(0)).bits()};
  for (int bit = 0; bit < 64; ++bit) first.insert(Rng(Seed(std::uint64_t{1} << bit)).bits());
  EXPECT_EQ(first.size(), 65u);
}

TEST(Random, StreamsDependOnNamesAndIndicesAlone) {
  const Seed root(42);
  EXPECT_EQ(root.child("layer1").child(3).key(), Seed(42).child("layer1").child(3).key());
  std::set<std::uint64_t> keys;
  for (int i = 0; i < 1000; ++i) {
    keys.insert(root.child(static_cast<std::uint64_t>(i)).key());
    keys.insert(root.child(std::to_string(i)).key());
    keys.insert(root.child("layer").child(static_cast<std::uint64_t>(i)).key());
  }
  EXPECT_EQ(keys.size(), 3000u);
  EXPECT_NE(root.child("ab").child("c").key(), root.child("a").child("bc").key());
  EXPECT_NE(root.child("a").key(), root.child(std::string_view("a\0", 2)).key());
}

TEST(Random, UniformFillsItsRangeEvenly) {
  Rng rng(Seed(7));
  constexpr int kDraws = 200000, kBins = 50;
  std::vector<int> counts(kBins);
  for (int i = 0; i < kDraws; ++i) {
    const float u = rng.uniform();
    ASSERT_GE(u, 0.0f);
    ASSERT_LT(u, 1.0f);
    ++counts[static_cast<std::size_t>(u * kBins)];
  }
  double chi2 = 0;
  for (const int c : counts) chi2 += (c - kDraws / kBins) * (c - kDraws / kBins) / double(kDraws / kBins);
  EXPECT_LT(chi2, 85.4);  // 99.9 % of chi-square with 49 degrees of freedom
}

TEST(Random, RangesAndDoublesAreOfTheSameDraws) {
  Rng rng(Seed(9)), same(Seed(9));
  for (int i = 0; i < 100; ++i) EXPECT_EQ(rng.uniform(-2, 3), -2 + 5 * same.uniform());
  for (int i = 0; i < 100; ++i) {
    const std::uint64_t high = same.bits(), low = same.bits();
    EXPECT_EQ(rng.uniform_double(), static_cast<double>((high << 32 | low) >> 11) * 0x1p-53);
  }
}

TEST(Random, BelowIsUnbiasedWhereManyDrawsAreRejected) {
  Rng rng(Seed(10));
  constexpr std::uint32_t n = 3u << 30;  // a fourth of all; else every third number would come twice as often
  std::vector<int> counts(3);
  for (int i = 0; i < 30000; ++i) {
    const std::uint32_t drawn = rng.below(n);
    ASSERT_LT(drawn, n);
    ++counts[drawn % 3];
  }
  for (const int c : counts) EXPECT_NEAR(c, 10000, 4 * 82);
}

TEST(Random, BelowIsUnbiased) {
  Rng rng(Seed(8));
  std::vector<int> counts(3);
  for (int i = 0; i < 300000; ++i) ++counts[rng.below(3)];
  for (const int c : counts) EXPECT_NEAR(c, 100000, 4 * 258);
}

}  // namespace
}  // namespace hbr
