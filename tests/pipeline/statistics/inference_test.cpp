#include "pipeline/statistics/inference.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numeric>

#include "pipeline/core/check.h"
#include "pipeline/core/random.h"
#include "pipeline/statistics/rank_sum.h"

namespace hbr {
namespace {

using testing::ElementsAre;

TEST(AdjustedTogether, IsHolmsByHand) {
  // Sorted 0.01, 0.03, 0.04 times 3, 2, 1; none may be less than one before it.
  EXPECT_THAT(adjusted_together(std::vector<double>{0.04, 0.01, 0.03}),
              ElementsAre(testing::DoubleEq(0.06), testing::DoubleEq(0.03), testing::DoubleEq(0.06)));
  EXPECT_THAT(adjusted_together(std::vector<double>{0.5, 0.9}), ElementsAre(1, 1));
  EXPECT_THAT(adjusted_together(std::vector<double>{0.2}), ElementsAre(0.2));
  EXPECT_TRUE(adjusted_together({}).empty());
}

// Of tests of nothing but chance, one of twenty families at the level 0.05 tells of something, whatever the
// size.
TEST(AdjustedTogether, HoldsItsLevelInAFamily) {
  Rng rng(Seed(41));
  int told = 0;
  constexpr int kFamilies = 4000;
  for (int family = 0; family < kFamilies; ++family) {
    std::vector<double> p(12);
    for (double& value : p) value = rng.uniform_double();
    const std::vector<double> adjusted = adjusted_together(p);
    told += *std::ranges::min_element(adjusted) < 0.05;
  }
  EXPECT_NEAR(told, 0.05 * kFamilies, 5 * std::sqrt(0.05 * 0.95 * kFamilies));
}

// Samples of two normal distributions of which one's values are greater with a chance of 0.71.
TEST(ReplicationsToTell, AreEnoughFourTimesOfFive) {
  EXPECT_EQ(replications_to_tell(0.71, 0.05), 30);  // (1.960 + 0.842)^2 / (6 * 0.21^2) = 29.7
  EXPECT_EQ(replications_to_tell(0.29, 0.05), 30);
  EXPECT_GT(replications_to_tell(0.71, 0.001).value(), 60);
  EXPECT_FALSE(replications_to_tell(0.5, 0.05));
  EXPECT_FALSE(replications_to_tell(0.50005, 2e-19));
  Rng rng(Seed(43));
  const auto normal = [&](double mean) {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += rng.uniform_double();
    return mean + sum;
  };
  int told = 0;
  constexpr int kTrials = 1500;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<double> a(30), b(30);
    for (double& x : a) x = normal(0.7826);  // the 0.71-quantile times the square root of two
    for (double& x : b) x = normal(0);
    told += rank_sum(a, b).p < 0.05;
  }
  EXPECT_NEAR(told / static_cast<double>(kTrials), kPower, 0.04);
}

double mean_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// Of a mean it is about two standard errors to either side, and holds the truth as often as it says.
TEST(Bootstrap, OfAMeanIsTheTextbooks) {
  Rng rng(Seed(42));
  int held = 0;
  constexpr int kRounds = 300, kValues = 40;
  double width = 0;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<double> values(kValues);
    for (double& value : values) value = rng.uniform_double();  // mean 1/2, variance 1/12
    const Interval interval = bootstrap(
        values, {}, [](auto a, auto) { return mean_of(a); }, std::to_string(round));
    held += interval.low <= 0.5 && 0.5 <= interval.high;
    width += (interval.high - interval.low) / kRounds;
  }
  EXPECT_NEAR(width, 2 * 1.96 * std::sqrt(1 / 12.0 / kValues), 0.01);
  EXPECT_NEAR(held / static_cast<double>(kRounds), kConfidence, 0.04);
}

TEST(Bootstrap, DrawsBothSamplesAndIsRepeatable) {
  const std::vector<double> a{1, 2, 3, 4}, b{10, 20};
  const Effect sum = [](std::span<const double> x, std::span<const double> y) {
    return mean_of(x) + mean_of(y);
  };
  const Interval one = bootstrap(a, b, sum, "n"), again = bootstrap(a, b, sum, "n");
  EXPECT_EQ(one.low, again.low);
  EXPECT_EQ(one.high, again.high);
  EXPECT_LT(one.low, 12.5);  // 10 at least of b
  EXPECT_GT(one.high, 21);
  const Interval equal = bootstrap(
      std::vector<double>{7, 7}, {}, [](auto x, auto) { return mean_of(x); }, "n");
  EXPECT_EQ(equal.low, 7);
  EXPECT_EQ(equal.high, 7);
  EXPECT_THROW(bootstrap({}, {}, sum, "n"), InputError);
  // Of two samples that are mostly zeros some draws have the ratio of two zeros, which is no number.
  const std::vector<double> zeros{0, 0, .05}, more{0, 0, .5};
  const Interval none = bootstrap(
      zeros, more, [](auto x, auto y) { return mean_of(x) / mean_of(y); }, "n");
  EXPECT_TRUE(std::isnan(none.low) && std::isnan(none.high));
}

}  // namespace
}  // namespace hbr
