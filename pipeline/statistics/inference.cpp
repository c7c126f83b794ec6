#include "pipeline/statistics/inference.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <limits>
#include <numeric>

#include "pipeline/core/check.h"
#include "pipeline/core/random.h"
#include "pipeline/statistics/summary.h"

namespace hbr::inline statistics {

std::vector<double> adjusted_together(std::span<const double> p) {
  std::vector<std::size_t> order(p.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return p[i]; });
  std::vector<double> adjusted(p.size());
  double least = 0;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    least = std::max(least, std::min(1.0, p[order[rank]] * static_cast<double>(p.size() - rank)));
    adjusted[order[rank]] = least;
  }
  return adjusted;
}

Interval bootstrap(std::span<const double> a, std::span<const double> b, const Effect& effect,
                   std::string_view name) {
  if (a.empty()) throw InputError("bootstrap of {}: no values; expected at least one", name);
  Rng rng(Seed(0).child("bootstrap").child(name));
  const auto draw = [&](std::span<const double> from, std::vector<double>& to) {
    for (double& value : to) value = from[rng.below(static_cast<std::uint32_t>(from.size()))];
  };
  std::vector<double> some_a(a.size()), some_b(b.size()), effects(kResamples);
  for (double& e : effects) {
    draw(a, some_a);
    draw(b, some_b);
    e = effect(some_a, some_b);
  }
  if (std::ranges::any_of(effects, [](double e) { return std::isnan(e); })) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    return {kNone, kNone};
  }
  std::ranges::sort(effects);
  const double tail = (1 - kConfidence) / 2;
  return {quantile(effects, tail), quantile(effects, 1 - tail)};
}

std::optional<int> replications_to_tell(double a12, double level) {
  if (a12 == 0.5) return {};
  const boost::math::normal standard;
  const double z = quantile(complement(standard, level / 2)) + quantile(standard, kPower);
  // Of both samples together z^2 / (12 c (1 - c) (A12 - 1/2)^2), c = 1/2 the share of one of them.
  const double needed = std::ceil(z * z / (6 * std::pow(a12 - 0.5, 2)));
  if (needed > kMostToTell) return {};
  return static_cast<int>(needed);
}

}  // namespace hbr::inline statistics
