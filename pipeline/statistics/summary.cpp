#include "pipeline/statistics/summary.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "pipeline/core/check.h"

namespace hbr::inline statistics {
namespace {

void sort_finite(std::vector<double>& values, const char* what) {
  if (values.empty()) throw InputError("{}: no values; expected at least one", what);
  for (const double value : values)
    if (!std::isfinite(value)) throw InputError("{}: a value is {}; expected finite numbers", what, value);
  std::ranges::sort(values);
}

Summary of_sorted(const std::vector<double>& sorted) {
  return {sorted.size(),         sorted.front(),         quantile(sorted, 0.25),
          quantile(sorted, 0.5), quantile(sorted, 0.75), sorted.back()};
}

}  // namespace

double quantile(std::span<const double> sorted, double q) {
  HBR_CHECK(!sorted.empty() && q >= 0 && q <= 1, "n = {}, q = {}", sorted.size(), q);
  const double place = q * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  const double share = place - static_cast<double>(below);
  return sorted[below] + share * (sorted[above] - sorted[below]);
}

Summary summarise(std::vector<double> values, const char* what) {
  sort_finite(values, what);
  return of_sorted(values);
}

Box box(std::vector<double> values, const char* what) {
  sort_finite(values, what);
  Box result;
  result.all = of_sorted(values);
  const double reach = 1.5 * (result.all.q3 - result.all.q1);
  const auto first = std::ranges::lower_bound(values, result.all.q1 - reach);
  const auto last = std::ranges::upper_bound(values, result.all.q3 + reach);
  result.low = *first;
  result.high = *(last - 1);
  result.below = static_cast<std::size_t>(first - values.begin());
  result.above = static_cast<std::size_t>(values.end() - last);
  return result;
}

double mean(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace hbr::inline statistics
