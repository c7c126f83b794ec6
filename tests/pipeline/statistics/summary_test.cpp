#include "pipeline/statistics/summary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "pipeline/core/check.h"
#include "pipeline/core/random.h"

namespace hbr {
namespace {

TEST(Summary, QuartilesInterpolateBetweenOrderStatistics) {
  // R: quantile(c(7, 15, 36, 39, 40, 41)) is 7, 20.25, 37.5, 39.75, 41.
  const Summary s = summarise({39, 7, 41, 15, 40, 36}, "test");
  EXPECT_EQ(s.n, 6u);
  EXPECT_DOUBLE_EQ(s.minimum, 7);
  EXPECT_DOUBLE_EQ(s.q1, 20.25);
  EXPECT_DOUBLE_EQ(s.median, 37.5);
  EXPECT_DOUBLE_EQ(s.q3, 39.75);
  EXPECT_DOUBLE_EQ(s.maximum, 41);
}

TEST(Summary, OfOneAndOfTwoValues) {
  const Summary one = summarise({3}, "test");
  EXPECT_EQ(one.q1, 3);
  EXPECT_EQ(one.median, 3);
  EXPECT_EQ(one.q3, 3);
  const Summary two = summarise({4, 2}, "test");
  EXPECT_DOUBLE_EQ(two.q1, 2.5);
  EXPECT_DOUBLE_EQ(two.median, 3);
  EXPECT_DOUBLE_EQ(two.q3, 3.5);
}

TEST(Summary, MirrorsWithItsValues) {
  Rng rng(Seed(3));
  std::vector<double> values, mirrored;
  for (int i = 0; i < 37; ++i) {
    values.push_back(rng.uniform_double());
    mirrored.push_back(-values.back());
  }
  const Summary s = summarise(values, "test"), m = summarise(mirrored, "test");
  EXPECT_DOUBLE_EQ(s.q1, -m.q3);
  EXPECT_DOUBLE_EQ(s.median, -m.median);
  EXPECT_DOUBLE_EQ(s.minimum, -m.maximum);
}

TEST(Summary, RefusesNoValuesAndNoNumbers) {
  EXPECT_THROW(summarise({}, "test"), InputError);
  EXPECT_THROW(summarise({1, std::numeric_limits<double>::quiet_NaN()}, "test"), InputError);
  EXPECT_THROW(box({std::numeric_limits<double>::infinity()}, "test"), InputError);
}

TEST(Box, WhiskersEndAtTheLastValueWithinTheFences) {
  // Quartiles 3 and 7, fences -3 and 13.
  const Box b = box({1, 2, 3, 4, 5, 6, 7, 13, 13.5}, "test");
  EXPECT_DOUBLE_EQ(b.all.q1, 3);
  EXPECT_DOUBLE_EQ(b.all.q3, 7);
  EXPECT_EQ(b.low, 1);
  EXPECT_EQ(b.high, 13);
  EXPECT_EQ(b.below, 0u);
  EXPECT_EQ(b.above, 1u);
  EXPECT_EQ(b.all.maximum, 13.5);
}

TEST(Box, CountsOutliersAsALoopWould) {
  Rng rng(Seed(5));
  std::vector<double> values;
  for (int i = 0; i < 500; ++i) values.push_back(1 / (rng.uniform_double() - 0.5));
  const Box b = box(values, "test");
  const double reach = 1.5 * (b.all.q3 - b.all.q1);
  std::size_t below = 0, above = 0;
  for (const double v : values) {
    if (v < b.all.q1 - reach) ++below;
    if (v > b.all.q3 + reach) ++above;
  }
  EXPECT_GT(below, 0u);
  EXPECT_GT(above, 0u);
  EXPECT_EQ(b.below, below);
  EXPECT_EQ(b.above, above);
}

}  // namespace
}  // namespace hbr
