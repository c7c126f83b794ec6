#include "pipeline/statistics/rank_correlation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "pipeline/core/check.h"
#include "pipeline/core/random.h"

namespace hbr {
namespace {

TEST(RankCorrelation, IsOneForTheSameOrderAndMinusOneForTheOpposite) {
  const std::vector<double> a{0.1, 5, -3, 2}, b{10, 1000, 1, 100};
  EXPECT_DOUBLE_EQ(rank_correlation(a, b), 1);
  std::vector<double> minus;
  for (double value : b) minus.push_back(-std::log(value));
  EXPECT_DOUBLE_EQ(rank_correlation(a, minus), -1);
}

// Without ties it is 1 - 6 sum d^2 / (n (n^2 - 1)), d the difference of the ranks.
TEST(RankCorrelation, EqualsTheClosedFormWithoutTies) {
  Rng rng{Seed(1)};
  std::vector<double> a, b;
  for (int i = 0; i < 50; ++i)
    a.push_back(rng.uniform_double()), b.push_back(a.back() + rng.uniform_double());
  const auto rank = [](const std::vector<double>& all, double value) {
    int below = 0;
    for (double other : all) below += other < value;
    return below;
  };
  double squares = 0;
  for (int i = 0; i < 50; ++i) squares += std::pow(rank(a, a[i]) - rank(b, b[i]), 2);
  EXPECT_NEAR(rank_correlation(a, b), 1 - 6 * squares / (50. * (2500 - 1)), 1e-12);
}

TEST(RankCorrelation, SharesTheRanksOfEqualValues) {
  // Ranks 1, 2.5, 2.5, 4 against 1, 2, 3, 4: 4.5 / sqrt(4.5 * 5).
  EXPECT_NEAR(rank_correlation(std::vector<double>{1, 2, 2, 3}, std::vector<double>{1, 2, 3, 4}),
              4.5 / std::sqrt(22.5), 1e-12);
  EXPECT_EQ(rank_correlation(std::vector<double>{1, 1, 1}, std::vector<double>{1, 2, 3}), 0);
}

TEST(RankCorrelation, RefusesWhatCannotBeRanked) {
  const std::vector<double> one{1}, two{1, 2}, nan{1, NAN};
  EXPECT_THROW(rank_correlation(one, one), InputError);
  EXPECT_THROW(rank_correlation(one, two), InputError);
  EXPECT_THROW(rank_correlation(two, nan), InputError);
}

}  // namespace
}  // namespace hbr
