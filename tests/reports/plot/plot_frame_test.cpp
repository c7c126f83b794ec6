#include "reports/plot/plot_frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace hbr {
namespace {

// Of ranges of all sizes and places: enough ticks to read a scale from, never so many that they touch.
TEST(Ticks, ThreeToSevenRoundNumbersWithinTheRange) {
  for (int e = -9; e < 9; ++e)
    for (double low = -3.7; low < 4; low += 0.313)
      for (double span = 0.1; span < 12; span *= 1.17) {
        const double scale = std::pow(10.0, e), from = low * scale, to = (low + span) * scale;
        const std::vector<double> ticks = round_ticks(from, to);
        ASSERT_GE(ticks.size(), 3u) << from << " " << to;
        ASSERT_LE(ticks.size(), 7u) << from << " " << to;
        EXPECT_TRUE(std::ranges::is_sorted(ticks));
        EXPECT_GE(ticks.front(), from - 1e-6 * span * scale);
        EXPECT_LE(ticks.back(), to + 1e-6 * span * scale);
        const auto labels = tick_labels(ticks);
        EXPECT_EQ(std::set(labels.begin(), labels.end()).size(), ticks.size());
      }
}

TEST(Ticks, OfALogarithmicAxis) {
  EXPECT_EQ(tick_labels(log_ticks(0.5, 2e4)),
            (std::vector<std::string>{"1", "10", "100", "1\u202f000", "10\u202f000"}));
  EXPECT_EQ(tick_labels(log_ticks(0.9, 6)), (std::vector<std::string>{"1", "2", "5"}));
  EXPECT_EQ(tick_labels(log_ticks(2.1, 2.9)), (std::vector<std::string>{"2.2", "2.4", "2.6", "2.8"}));
  for (double low = 1e-5; low < 1e5; low *= 1.9)
    for (double ratio = 1.1; ratio < 1e6; ratio *= 1.7) {
      const std::vector<double> ticks = log_ticks(low, low * ratio);
      EXPECT_GE(ticks.size(), 3u) << low << " " << ratio;
      EXPECT_LE(ticks.size(), 8u) << low << " " << ratio;
    }
}

TEST(Ticks, LabelsAreExact) {
  EXPECT_EQ(tick_labels({0, 0.05, 0.1}), (std::vector<std::string>{"0", "0.05", "0.1"}));
  EXPECT_EQ(tick_labels({0.25, 0.3, 0.35}), (std::vector<std::string>{"0.25", "0.30", "0.35"}));
  EXPECT_EQ(tick_labels({-1, -0.5}), (std::vector<std::string>{"−1", "−0.5"}));
}

// gnuplot runs what stands between backquotes, even in quotes, and writes numbers in place of a label's %.
TEST(Words, AreNoCommandsOfGnuplot) {
  EXPECT_EQ(gnuplot_quoted("a`b"), "\"a\\140b\"");
  EXPECT_EQ(gnuplot_quoted("\"c\" \\d\n%"), "\"\\\"c\\\" \\\\d\\n%\"");
  EXPECT_EQ(gnuplot_tick("50 % `e`", 2), "\"50 %% \\140e\\140\" 2");
}

}  // namespace
}  // namespace hbr
