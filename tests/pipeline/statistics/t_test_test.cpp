#include "pipeline/statistics/t_test.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace hbr {
namespace {

// With two degrees of freedom P(|T| > t) = 1 - t / sqrt(2 + t^2), with one 1 - 2 / pi atan(t).
TEST(TTest, AgainstItsClosedForms) {
  const std::vector<double> a{1, 3}, b{6, 10};  // means 2 and 8, variance (2 + 8) / 2 = 5
  const double t = 6 / std::sqrt(5.0);
  EXPECT_NEAR(t_test(a, b), 1 - t / std::sqrt(2 + t * t), 1e-12);
  EXPECT_DOUBLE_EQ(t_test(b, a), t_test(a, b));
  const std::vector<double> one{5};  // beside 1 and 3: mean 2, variance 2
  EXPECT_NEAR(t_test(a, one), 1 - 2 / M_PI * std::atan(3 / std::sqrt(2 * 1.5)), 1e-12);
}

TEST(TTest, OfEqualMeansAndOfNoVariance) {
  const std::vector<double> a{1, 3}, b{2, 2}, c{7, 7, 7};
  EXPECT_EQ(t_test(a, b), 1);
  EXPECT_EQ(t_test(b, c), 0);
  EXPECT_EQ(t_test(c, c), 1);
}

}  // namespace
}  // namespace hbr
