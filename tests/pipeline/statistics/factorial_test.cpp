#include "pipeline/statistics/factorial.h"

#include <gmock/gmock.h>

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
  const std::vector<Levels> three{{0}, {0}, {1}, {1}, {2}, {2}};
  const std::vector<double> y{1, 2, 4, 5, 6, 9};
  const FactorialAnalysis alone = analyse_factorial({3}, three, y);
  std::vector<Levels> runs;
  std::vector<double> responses;
  for (std::size_t r = 0; r < three.size(); ++r)
    for (int idle = 0; idle < 4; ++idle) {
      runs.push_back({idle / 2, three[r][0], idle % 2});
      responses.push_back(y[r]);
    }
  const FactorialAnalysis copied = analyse_factorial({2, 3, 2}, runs, responses);
  EXPECT_EQ(alone.runs, 6);
  EXPECT_EQ(copied.runs, 6);
  ASSERT_EQ(copied.terms.size(), 6u);  // three factors and their pairs
  EXPECT_EQ(copied.terms[1].factors, std::vector<int>{1});
  EXPECT_DOUBLE_EQ(copied.terms[1].share, alone.terms[0].share);
  EXPECT_DOUBLE_EQ(copied.terms[1].p.value(), alone.terms[0].p.value());
  EXPECT_EQ(copied.effects[1], alone.effects[0]);
  EXPECT_EQ(copied.unexplained, alone.unexplained);
  for (const std::size_t idle : {0u, 2u, 3u, 4u, 5u}) {
    EXPECT_EQ(copied.terms[idle].share, 0) << idle;
    EXPECT_FALSE(copied.terms[idle].p) << idle;
  }
  EXPECT_EQ(copied.effects[0], (std::vector<double>{0, 0}));
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
