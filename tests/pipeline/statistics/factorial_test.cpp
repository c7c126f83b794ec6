#include "pipeline/statistics/factorial.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

namespace hbr {
namespace {

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

// A response that does not hang on a factor is the same run made twice: that makes no evidence.
TEST(FactorialAnalysis, CountsCopiesOnce) {
  const std::vector<int> three(3, 2), five(5, 2);
  const auto response = [](int a, int b, int c) { return 1.0 + a + 0.5 * b + 0.25 * c + 0.125 * a * b * c; };
  std::vector<double> once, copied;
  for (const Levels& run : factorial_design(three, 0)) once.push_back(response(run[0], run[1], run[2]));
  for (const Levels& run : factorial_design(five, 0)) copied.push_back(response(run[1], run[2], run[4]));
  const FactorialAnalysis alone = analyse_factorial(three, factorial_design(three, 0), once),
                          among = analyse_factorial(five, factorial_design(five, 0), copied);
  EXPECT_EQ(alone.runs, 8);
  EXPECT_EQ(among.runs, 8);
  EXPECT_DOUBLE_EQ(among.unexplained, alone.unexplained);
  ASSERT_EQ(among.terms.size(), 15u);
  const std::vector<int> place{1, 2, 4};
  for (const Term& term : alone.terms) {
    std::vector<int> factors;
    for (const int f : term.factors) factors.push_back(place[static_cast<std::size_t>(f)]);
    const auto same = std::ranges::find(among.terms, factors, &Term::factors);
    ASSERT_NE(same, among.terms.end());
    EXPECT_DOUBLE_EQ(same->share, term.share);
    EXPECT_DOUBLE_EQ(same->p.value(), term.p.value());
  }
  for (const Term& term : among.terms)
    if (std::ranges::any_of(term.factors, [](int f) { return f == 0 || f == 3; })) {
      EXPECT_EQ(term.share, 0);
      EXPECT_FALSE(term.p);
    }
  EXPECT_EQ(among.effects[4], alone.effects[2]);
  EXPECT_EQ(among.effects[0], (std::vector<double>{0, 0}));
}

// Two factors that matter beside one that does not: their pair keeps its place.
TEST(FactorialAnalysis, CopiesKeepThePairsOfWhatMatters) {
  const std::vector<int> levels{2, 2, 2};
  const std::vector<Levels> runs = factorial_design(levels, 0);
  std::vector<double> y;
  for (const Levels& run : runs) y.push_back(3 * run[0] + run[0] * run[2] - run[2]);
  const FactorialAnalysis analysis = analyse_factorial(levels, runs, y);
  EXPECT_EQ(analysis.runs, 4);
  ASSERT_EQ(analysis.terms.size(), 6u);
  for (std::size_t t = 0; t < 6; ++t) {
    const bool matters = t == 0 || t == 2 || t == 4;  // 0, 2, and 0 with 2
    EXPECT_EQ(analysis.terms[t].share > 0.01, matters) << t;
  }
  EXPECT_EQ(analysis.terms[4].factors, (std::vector<int>{0, 2}));
  EXPECT_NEAR(analysis.effects[0][1], 3.5, 1e-12);
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
