#include "reports/text/format.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hbr {
namespace {

TEST(Format, KeepsWholeNumbersWhole) {
  EXPECT_EQ(format_number(0), "0");
  EXPECT_EQ(format_number(7), "7");
  EXPECT_EQ(format_number(1397), "1\u202f397");
  EXPECT_EQ(format_number(745000), "745\u202f000");
  EXPECT_EQ(format_number(1397.4), "1\u202f397");
}

TEST(Format, RoundsToThreeDigits) {
  EXPECT_EQ(format_number(2.345), "2.35");
  EXPECT_EQ(format_number(0.029621), "0.0296");
  EXPECT_EQ(format_number(-0.8), "−0.800");
  EXPECT_EQ(format_number(9.996), "10.0");
  EXPECT_EQ(format_number(99.96), "100");
  EXPECT_EQ(format_number(0.92), "0.920");
}

TEST(Format, WritesPowersOfTen) {
  EXPECT_EQ(format_number(6.5e-5), "6.50·10⁻⁵");
  EXPECT_EQ(format_number(-2.7e-4, 2), "−2.7·10⁻⁴");
  EXPECT_EQ(power_of_ten(-18), "10⁻¹⁸");
  EXPECT_EQ(power_of_ten(7), "10⁷");
}

TEST(Format, SaysWhereThereIsNoNumber) {
  EXPECT_EQ(format_number(NAN), "–");
  EXPECT_EQ(format_number(INFINITY), "–");
  EXPECT_EQ(format_p(NAN), "–");
}

TEST(Format, WritesProbabilities) {
  EXPECT_EQ(format_p(7.066e-18), "7.1·10⁻¹⁸");
  EXPECT_EQ(format_p(0.034), "0.034");
  EXPECT_EQ(format_p(0.0042), "0.0042");
  EXPECT_EQ(format_p(0.1), "0.10");
  EXPECT_EQ(format_p(1), "1.00");
  EXPECT_EQ(format_p(0), "< 10⁻³⁰⁰");
}

TEST(Format, WritesUnitsThatAreSymbolsOnly) {
  EXPECT_EQ(format_quantity(0.916, "%"), "0.916\u202f%");
  EXPECT_EQ(format_quantity(2.7e-4, "m^2"), "2.70·10⁻⁴\u202fm²");
  EXPECT_EQ(format_quantity(25.04, "mm"), "25.0\u202fmm");
  EXPECT_EQ(format_quantity(138, "elites"), "138");
  EXPECT_EQ(format_quartiles(1397, 1335, 1520, "elites"), "1\u202f397 [1\u202f335; 1\u202f520]");
}

}  // namespace
}  // namespace hbr
