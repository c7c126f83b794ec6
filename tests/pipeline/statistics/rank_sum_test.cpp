#include "pipeline/statistics/rank_sum.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "pipeline/core/check.h"
#include "pipeline/core/random.h"

namespace hbr {
namespace {

std::vector<double> sequence(int first, int n) {
  std::vector<double> values;
  for (int i = 0; i < n; ++i) values.push_back(first + i);
  return values;
}

// U by its definition: pairs in which a is greater.
double pairs_won(const std::vector<double>& a, const std::vector<double>& b) {
  double won = 0;
  for (const double x : a)
    for (const double y : b) won += x > y ? 1 : x == y ? 0.5 : 0;
  return won;
}

// Samples of the given sizes whose U is `u`: from a wholly below b, swap neighbours until u pairs are won.
std::pair<std::vector<double>, std::vector<double>> with_u(int n_a, int n_b, int u) {
  std::vector<bool> from_a(static_cast<std::size_t>(n_a + n_b));
  for (int i = 0; i < n_a; ++i) from_a[static_cast<std::size_t>(i)] = true;
  while (u > 0)
    for (std::size_t i = from_a.size() - 1; i-- > 0 && u > 0;)
      if (from_a[i] && !from_a[i + 1]) {
        from_a[i] = false, from_a[i + 1] = true;
        --u;
      }
  std::pair<std::vector<double>, std::vector<double>> samples;
  for (std::size_t i = 0; i < from_a.size(); ++i)
    (from_a[i] ? samples.first : samples.second).push_back(static_cast<double>(i));
  return samples;
}

TEST(RankSum, EffectSizeIsTheShareOfPairsWon) {
  Rng rng(Seed(9));
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<double> a(1 + rng.below(30)), b(1 + rng.below(30));
    for (auto* values : {&a, &b})
      for (double& value : *values) value = rng.below(12);
    const double expected = pairs_won(a, b) / static_cast<double>(a.size() * b.size());
    EXPECT_NEAR(effect_size(a, b), expected, 1e-12);
    EXPECT_EQ(effect_size(a, b), rank_sum(a, b).a12);
  }
  EXPECT_THROW(effect_size({}, sequence(0, 2)), InputError);
}

TEST(RankSum, CompleteSeparationOfFiftyAgainstFifty) {
  const RankSum test = rank_sum(sequence(0, 50), sequence(50, 50));
  EXPECT_EQ(test.u, 0);
  EXPECT_EQ(test.a12, 0);
  EXPECT_NEAR(test.p, 7.066e-18, 0.0005e-18);
  ASSERT_TRUE(test.p_exact);
  EXPECT_NEAR(*test.p_exact, 2 / 1.00891344545564193334812497256e29, 1e-40);  // 2 / binomial(100, 50)
  EXPECT_EQ(least_p(50, 50), test.p);
}

// Critical values of U, two-sided at 0.05, from the published tables (Mann and Whitney 1947; Siegel 1956,
// table K; Milton 1964): the greatest U that is significant.
TEST(RankSum, PublishedCriticalValues) {
  struct Entry {
    int n_a, n_b, critical;
  };
  for (const auto& [n_a, n_b, critical] :
       {Entry{4, 4, 0}, Entry{5, 5, 2}, Entry{5, 8, 6}, Entry{6, 6, 5}, Entry{7, 7, 8}, Entry{8, 8, 13},
        Entry{8, 10, 17}, Entry{9, 9, 17}, Entry{10, 10, 23}, Entry{10, 15, 39}, Entry{12, 12, 37},
        Entry{15, 15, 64}, Entry{15, 20, 90}, Entry{20, 20, 127}}) {
    const auto [a, b] = with_u(n_a, n_b, critical);
    const RankSum at = rank_sum(a, b);
    EXPECT_EQ(at.u, critical);
    EXPECT_LE(at.p_exact.value(), 0.05) << n_a << " against " << n_b;
    const auto [c, d] = with_u(n_a, n_b, critical + 1);
    EXPECT_GT(rank_sum(c, d).p_exact.value(), 0.05) << n_a << " against " << n_b;
  }
}

// Probabilities of U from Mann and Whitney's own table (1947), one-sided: n = m = 4 and 5.
TEST(RankSum, PublishedProbabilities) {
  const std::vector<double> four = {.014, .029, .057, .100, .171, .243, .343, .443};
  for (std::size_t u = 0; u < four.size(); ++u) {
    const auto [a, b] = with_u(4, 4, static_cast<int>(u));
    EXPECT_NEAR(rank_sum(a, b).p_exact.value() / 2, four[u], 0.0006) << u;
  }
  const std::vector<double> five = {.004, .008, .016, .028, .048, .075, .111, .155, .210, .274, .345, .421};
  for (std::size_t u = 0; u < five.size(); ++u) {
    const auto [a, b] = with_u(5, 5, static_cast<int>(u));
    EXPECT_NEAR(rank_sum(a, b).p_exact.value() / 2, five[u], 0.0006) << u;
  }
}

TEST(RankSum, ExactEqualsAllSplitsCountedOneByOne) {
  for (int n_a = 1; n_a <= 6; ++n_a)
    for (int n_b = 1; n_b <= 6; ++n_b) {
      const int n = n_a + n_b;
      std::vector<double> splits(static_cast<std::size_t>(n_a * n_b + 1));
      double all = 0;
      for (unsigned mask = 0; mask < 1u << n; ++mask) {
        if (std::popcount(mask) != n_a) continue;
        int u = 0;
        for (int i = 0; i < n; ++i)
          for (int j = 0; j < i; ++j) u += (mask >> i & 1) && !(mask >> j & 1) ? 1 : 0;
        splits[static_cast<std::size_t>(u)] += 1;
        all += 1;
      }
      for (int u = 0; u <= n_a * n_b; ++u) {
        double lower = 0, upper = 0;
        for (int i = 0; i <= n_a * n_b; ++i) {
          if (i <= u) lower += splits[static_cast<std::size_t>(i)];
          if (i >= u) upper += splits[static_cast<std::size_t>(i)];
        }
        const auto [a, b] = with_u(n_a, n_b, u);
        EXPECT_NEAR(rank_sum(a, b).p_exact.value(), std::min(1.0, 2 * std::min(lower, upper) / all), 1e-14);
      }
    }
}

TEST(RankSum, NormalApproximationNearsTheExactValue) {
  for (const int u : {0, 300, 350, 400, 449}) {
    const auto [a, b] = with_u(30, 30, u);
    const RankSum test = rank_sum(a, b);
    if (u > 0)
      EXPECT_NEAR(test.p_normal / test.p_exact.value(), 1, 0.05) << u;
    else
      EXPECT_GT(test.p_normal,
                test.p_exact.value());  // the floor of the approximation lies above the exact one
  }
}

// With ties the variance is that of mid-ranks drawn without replacement: compare with all splits.
TEST(RankSum, TieCorrectionIsTheVarianceOverAllSplits) {
  const std::vector<double> pool = {1, 1, 2, 3, 3, 3, 4, 5, 5, 6};
  constexpr unsigned kA = 4;
  double sum = 0, squares = 0, n = 0;
  for (unsigned mask = 0; mask < 1u << pool.size(); ++mask) {
    if (std::popcount(mask) != kA) continue;
    std::vector<double> a, b;
    for (std::size_t i = 0; i < pool.size(); ++i) (mask >> i & 1 ? a : b).push_back(pool[i]);
    const double u = pairs_won(a, b);
    sum += u, squares += u * u, n += 1;
  }
  const double variance = squares / n - (sum / n) * (sum / n);

  const std::vector<double> a = {4, 5, 5, 6}, b = {1, 1, 2, 3, 3, 3};
  const RankSum test = rank_sum(a, b);
  EXPECT_EQ(test.u, 24);
  const double z = (24 - 12 - 0.5) / std::sqrt(variance);
  EXPECT_NEAR(test.p_normal, std::erfc(z / std::sqrt(2.0)), 1e-14);
}

TEST(RankSum, IdentitiesOfU) {
  Rng rng(Seed(11));
  for (int round = 0; round < 200; ++round) {
    std::vector<double> a(1 + rng.below(20)), b(1 + rng.below(20));
    for (double& x : a) x = rng.below(15);
    for (double& x : b) x = rng.below(15);
    const RankSum ab = rank_sum(a, b), ba = rank_sum(b, a);
    EXPECT_DOUBLE_EQ(ab.u, pairs_won(a, b));
    EXPECT_DOUBLE_EQ(ab.a12 + ba.a12, 1);
    EXPECT_DOUBLE_EQ(ab.p, ba.p);
    EXPECT_GE(ab.p, 0);
    EXPECT_LE(ab.p, 1);
    for (double& x : a) x = std::exp(x);  // ranks are all that counts
    for (double& x : b) x = std::exp(x);
    EXPECT_EQ(rank_sum(a, b).p, ab.p);
  }
}

TEST(RankSum, EqualValuesTellNothing) {
  const RankSum test = rank_sum(std::vector<double>{2, 2, 2}, std::vector<double>{2, 2});
  EXPECT_EQ(test.p, 1);
  EXPECT_EQ(test.p_normal, 1);
  EXPECT_EQ(test.a12, 0.5);
}

TEST(RankSum, SmallSamplesAreToldExactly) {
  const RankSum ten = rank_sum(sequence(0, 10), sequence(10, 10)),
                more = rank_sum(sequence(0, 21), sequence(21, 20));
  EXPECT_EQ(ten.p, ten.p_exact.value());
  EXPECT_NEAR(ten.p, 2 / 184756.0, 1e-18);  // binomial(20, 10)
  EXPECT_EQ(ten.p, least_p(10, 10));
  EXPECT_EQ(more.p, more.p_normal);
  EXPECT_NE(more.p, more.p_exact.value());
  EXPECT_EQ(more.p, least_p(21, 20));
}

// Of the splits of all values, those with a rank sum as far from the mean: counted one by one.
TEST(RankSum, IsExactWithTies) {
  Rng rng(Seed(12));
  for (int round = 0; round < 60; ++round) {
    std::vector<double> a(3 + rng.below(3)), b(3 + rng.below(3)), pool;
    for (auto* values : {&a, &b})
      for (double& value : *values) pool.push_back(value = rng.below(4));
    const double centre = static_cast<double>(a.size() * b.size()) / 2,
                 found = std::abs(pairs_won(a, b) - centre);
    double as_far = 0, all = 0;
    for (unsigned mask = 0; mask < 1u << pool.size(); ++mask) {
      if (static_cast<std::size_t>(std::popcount(mask)) != a.size()) continue;
      std::vector<double> some, others;
      for (std::size_t i = 0; i < pool.size(); ++i) (mask >> i & 1 ? some : others).push_back(pool[i]);
      as_far += std::abs(pairs_won(some, others) - centre) >= found;
      all += 1;
    }
    const RankSum test = rank_sum(a, b);
    EXPECT_NEAR(test.p, as_far / all, 1e-12);
    // Of sizes that differ ties may leave one tail alone.
    EXPECT_GE(test.p, least_p(a.size(), b.size()) / 2 * (1 - 1e-12));
  }
  // The approximation has 0.047 here, and would call three values of a kind against three of another a
  // difference.
  EXPECT_NEAR(rank_sum(std::vector<double>(3, 10), std::vector<double>(3, 8)).p, 0.1, 1e-12);
}

TEST(RankSum, ExactOnlyWithinItsLimit) {
  EXPECT_TRUE(rank_sum(sequence(0, 100), sequence(100, 100)).p_exact);
  EXPECT_FALSE(rank_sum(sequence(0, 100), sequence(100, 101)).p_exact);
}

TEST(RankSum, RefusesNoValuesAndNoNumbers) {
  const std::vector<double> none, one = {1}, broken = {std::numeric_limits<double>::quiet_NaN()};
  EXPECT_THROW(rank_sum(none, one), InputError);
  EXPECT_THROW(rank_sum(one, none), InputError);
  EXPECT_THROW(rank_sum(one, broken), InputError);
}

}  // namespace
}  // namespace hbr
