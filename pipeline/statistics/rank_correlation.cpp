#include "pipeline/statistics/rank_correlation.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "pipeline/core/check.h"

namespace hbr::inline statistics {
namespace {

// Less their mean: twice the sum of ranks 0 to n - 1 is n (n - 1).
std::vector<double> centred_ranks(std::span<const double> values) {
  const std::size_t n = values.size();
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::sort(order, {}, [&](std::size_t i) { return values[i]; });
  std::vector<double> rank(n);
  for (std::size_t begin = 0, end = 0; begin < n; begin = end) {
    while (end < n && values[order[end]] == values[order[begin]]) ++end;
    for (std::size_t k = begin; k < end; ++k)
      rank[order[k]] = 0.5 * (static_cast<double>(begin + end) - static_cast<double>(n));
  }
  return rank;
}

}  // namespace

double rank_correlation(std::span<const double> a, std::span<const double> b) {
  const auto finite = [](double value) { return std::isfinite(value); };
  if (a.size() != b.size() || a.size() < 2 || !std::ranges::all_of(a, finite) ||
      !std::ranges::all_of(b, finite))
    throw InputError("rank correlation of {} and {} values; expected equally many, at least 2, all finite",
                     a.size(), b.size());
  const std::vector<double> x = centred_ranks(a), y = centred_ranks(b);
  const auto product = [](const std::vector<double>& u, const std::vector<double>& v) {
    return std::inner_product(u.begin(), u.end(), v.begin(), 0.0);
  };
  const double scale = std::sqrt(product(x, x) * product(y, y));
  return scale > 0 ? product(x, y) / scale : 0;
}

}  // namespace hbr::inline statistics
