// Five-number summaries and Tukey's boxes. Quartiles are those of linear interpolation between order
// statistics (Hyndman and Fan 1996, type 7: the q-quantile of n sorted values stands at index q (n - 1)), so
// that tables and figures agree.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace hbr::inline statistics {

struct Summary {
  std::size_t n = 0;
  double minimum = 0, q1 = 0, median = 0, q3 = 0, maximum = 0;
};

// As a boxplot draws it: the whiskers end at the extreme values within 1.5 interquartile ranges of the
// quartiles; what lies beyond is an outlier.
struct Box {
  Summary all;                       // outliers included
  double low = 0, high = 0;          // least and greatest value that is no outlier
  std::size_t below = 0, above = 0;  // outliers
};

// q in [0, 1]; `sorted` ascending and not empty.
double quantile(std::span<const double> sorted, double q);

// In any order. Throws InputError, naming `what`, where there is no value or one is not finite.
Summary summarise(std::vector<double> values, const char* what);
Box box(std::vector<double> values, const char* what);

double mean(std::span<const double> values);

}  // namespace hbr::inline statistics
