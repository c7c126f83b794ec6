#include "reports/claims/range_chart.h"

#include <gtest/gtest.h>

#include <regex>

namespace hbr {
namespace {

using nlohmann::json;

double number(const std::string& svg, const char* pattern) {
  std::smatch found;
  return std::regex_search(svg, found, std::regex(pattern)) ? std::stod(found[1]) : -1;
}

struct Chart {
  double from, width, mark;
};

Chart chart(double x, const json& reproduced, const json& partly) {
  const std::string svg = range_chart(
      {{"x", x}, {"reproduced", reproduced}, {"partly", partly}, {"figure", "<1>"}, {"asked", "2"}});
  EXPECT_NE(svg.find("aria-label=\"&lt;1&gt; where 2 is asked\""), std::string::npos) << svg;
  return {number(svg, "class=\"asked\" x=\"([0-9.]+)\""),
          number(svg, "class=\"asked\" x=\"[0-9.]+\" y=\"4\" width=\"([0-9.]+)\""),
          number(svg, "cx=\"([0-9.]+)\"")};
}

TEST(RangeChart, TheMarkLiesInTheRangeExactlyWhereTheNumberDoes) {
  for (const double x : {-0.5, 0.0, 0.9, 1.0, 1.5, 2.0, 2.1, 40.0, 3000.0}) {
    const Chart c = chart(x, {1, 2}, {0.5, 4});
    EXPECT_EQ(c.mark >= c.from - 0.11 && c.mark <= c.from + c.width + 0.11, x >= 1 && x <= 2) << x;
    EXPECT_GE(c.mark, 4.5);
    EXPECT_LE(c.mark, 170 - 4.5);
  }
}

TEST(RangeChart, ARangeWithoutAnEndReachesTheEdge) {
  const Chart c = chart(5, {2, nullptr}, {1, nullptr});
  EXPECT_NEAR(c.from + c.width, 170, 0.2);
  EXPECT_GT(c.mark, c.from);
}

// Far apart, they stand as their ratios do: 10 is in the middle of 1 and 100.
TEST(RangeChart, RatiosFarApartAreShownAsRatios) {
  const Chart c = chart(10, {1, 100}, {1, 100});
  EXPECT_NEAR(c.mark, c.from + c.width / 2, 0.2);
}

TEST(RangeChart, OneNumberAlone) {
  const Chart c = chart(120, {120, 120}, {120, 120});
  EXPECT_NEAR(c.mark, 85, 0.2);
  EXPECT_GE(c.width, 2);
}

}  // namespace
}  // namespace hbr
