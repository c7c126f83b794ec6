#include "pipeline/statistics/factorial.h"

#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <set>

#include "pipeline/core/check.h"

namespace hbr {
namespace {

using testing::HasSubstr;

// How often each combination of levels of some factors is among the runs.
std::map<Levels, int> counts(const std::vector<Levels>& runs, const std::vector<std::size_t>& factors) {
  std::map<Levels, int> count;
  for (const Levels& run : runs) {
    Levels part;
    for (const std::size_t f : factors) part.push_back(run[f]);
    ++count[part];
  }
  return count;
}

TEST(FactorialDesign, IsEveryCombinationInOrder) {
  const std::vector<Levels> all = factorial_design({2, 3}, 0);
  EXPECT_EQ(all, (std::vector<Levels>{{0, 0}, {0, 1}, {0, 2}, {1, 0}, {1, 1}, {1, 2}}));
  EXPECT_EQ(factorial_design({2, 3}, 6), all);
  EXPECT_EQ(factorial_design({2, 3}, 99), all);
  EXPECT_EQ(factorial_design({}, 0), std::vector<Levels>{{}});
}

// The known best fractions: eight of sixteen in which any three of four factors are complete (resolution IV),
// sixteen of thirty-two in which any four of five are (resolution V).
TEST(FactorialDesign, FindsTheHalvesOfTwoLevels) {
  const std::vector<Levels> half4 = factorial_design({2, 2, 2, 2}, 8),
                            half5 = factorial_design({2, 2, 2, 2, 2}, 16);
  ASSERT_EQ(half4.size(), 8u);
  for (std::size_t without = 0; without < 4; ++without) {
    std::vector<std::size_t> three;
    for (std::size_t f = 0; f < 4; ++f)
      if (f != without) three.push_back(f);
    EXPECT_EQ(counts(half4, three).size(), 8u) << without;
  }
  ASSERT_EQ(half5.size(), 16u);
  for (std::size_t without = 0; without < 5; ++without) {
    std::vector<std::size_t> four;
    for (std::size_t f = 0; f < 5; ++f)
      if (f != without) four.push_back(f);
    EXPECT_EQ(counts(half5, four).size(), 16u) << without;
  }
  for (const auto& runs : {half4, half5})
    EXPECT_EQ(std::set<Levels>(runs.begin(), runs.end()).size(), runs.size());
}

TEST(FactorialDesign, HoldsEveryLevelEquallyOften) {
  const std::vector<int> levels{3, 2, 2, 2, 2, 2};  // 96 combinations
  const std::vector<Levels> runs = factorial_design(levels, 24);
  ASSERT_EQ(runs.size(), 24u);
  EXPECT_EQ(runs[0], Levels(6, 0));
  EXPECT_TRUE(std::ranges::is_sorted(runs));
  for (std::size_t f = 0; f < levels.size(); ++f)
    for (std::size_t g = f + 1; g < levels.size(); ++g)
      for (const auto& [pair, count] : counts(runs, {f, g}))
        EXPECT_EQ(count, 24 / (levels[f] * levels[g])) << f << ' ' << g;
}

TEST(FactorialDesign, RefusesWhatNobodyRuns) {
  EXPECT_THAT([] { factorial_design(std::vector<int>(17, 2), 8); },
              testing::ThrowsMessage<InputError>(HasSubstr("more than 65536 combinations")));
}

// y = 5 + 3 a + 2 a b over levels -1 and 1: sums of squares 9 and 4 of 13.
TEST(FactorialAnalysis, OfAResponseByHand) {
  const std::vector<int> levels{2, 2, 2};
  const std::vector<Levels> runs = factorial_design(levels, 0);
  std::vector<double> y;
  for (const Levels& run : runs) {
    const int a = 2 * run[0] - 1, b = 2 * run[1] - 1;
    y.push_back(5 + 3 * a + 2 * a * b);
  }
  const FactorialAnalysis analysis = analyse_factorial(levels, runs, y);
  ASSERT_EQ(analysis.terms.size(), 6u);
  EXPECT_EQ(analysis.terms[0].factors, std::vector<int>{0});
  EXPECT_EQ(analysis.terms[3].factors, (std::vector<int>{0, 1}));
  const double expected[] = {9 / 13.0, 0, 0, 4 / 13.0, 0, 0};
  for (std::size_t t = 0; t < 6; ++t) {
    EXPECT_NEAR(analysis.terms[t].share, expected[t], 1e-12) << t;
    EXPECT_EQ(analysis.terms[t].degrees, 1) << t;
  }
  EXPECT_NEAR(analysis.unexplained, 0, 1e-12);
  EXPECT_NEAR(analysis.effects[0][1], 6, 1e-12);
  EXPECT_NEAR(analysis.effects[1][1], 0, 1e-12);
  EXPECT_EQ(analysis.effects[2][0], 0);
}

// One factor of three levels, two runs of each: the textbook's F = (SSB / 2) / (SSW / 3).
TEST(FactorialAnalysis, OfOneFactorIsTheTextbooks) {
  const std::vector<Levels> runs{{0}, {0}, {1}, {1}, {2}, {2}};
  const std::vector<double> y{1, 2, 4, 5, 6, 9};
  // Means 1.5, 4.5, 7.5 about 4.5: between 36, within 0.5 + 0.5 + 4.5.
  const FactorialAnalysis analysis = analyse_factorial({3}, runs, y);
  EXPECT_NEAR(analysis.terms[0].share, 36 / 41.5, 1e-12);
  EXPECT_EQ(analysis.terms[0].degrees, 2);
  EXPECT_NEAR(analysis.unexplained, 5.5 / 41.5, 1e-12);
  // P(F(2, 3) > f) = (1 + 2 f / 3)^(-3/2).
  const double f = (36 / 2.0) / (5.5 / 3);
  EXPECT_NEAR(analysis.terms[0].p.value(), std::pow(1 + 2 * f / 3, -1.5), 1e-12);
  EXPECT_EQ(analysis.effects[0].size(), 3u);
  EXPECT_NEAR(analysis.effects[0][1], 3, 1e-12);
  EXPECT_NEAR(analysis.effects[0][2], 6, 1e-12);
}

// Eight runs have no room for four factors' six pairs; factors that always change together can't be told
// apart.
TEST(FactorialAnalysis, SaysWhatItCanNotTell) {
  const std::vector<int> four(4, 2);
  const std::vector<Levels> half = factorial_design(four, 8);
  EXPECT_EQ(analyse_factorial(four, half, {1, 2, 3, 4, 5, 6, 7, 8}).terms.size(), 4u);
  const FactorialAnalysis together =
      analyse_factorial({2, 2}, {{0, 0}, {0, 0}, {1, 1}, {1, 1}}, {1, 2, 5, 6});
  for (const Term& term : together.terms) {
    EXPECT_EQ(term.degrees, 0);
    EXPECT_EQ(term.share, 0);
    EXPECT_FALSE(term.p);
  }
  const FactorialAnalysis constant = analyse_factorial({2}, {{0}, {1}}, {7, 7});
  EXPECT_EQ(constant.terms[0].share, 0);
  EXPECT_FALSE(constant.terms[0].p);
  EXPECT_EQ(constant.unexplained, 0);
}

}  // namespace
}  // namespace hbr
