#include "pipeline/statistics/t_test.h"

#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "pipeline/core/check.h"
#include "pipeline/statistics/summary.h"

namespace hbr::inline statistics {

double t_test(std::span<const double> a, std::span<const double> b) {
  HBR_CHECK(!a.empty() && !b.empty() && a.size() + b.size() >= 3, "{} and {} values", a.size(), b.size());
  const auto squares = [](std::span<const double> values, double about) {
    double sum = 0;
    for (const double value : values) sum += (value - about) * (value - about);
    return sum;
  };
  const double mean_a = mean(a), mean_b = mean(b);
  if (mean_a == mean_b) return 1;
  const auto n_a = static_cast<double>(a.size()), n_b = static_cast<double>(b.size());
  const double degrees = n_a + n_b - 2, variance = (squares(a, mean_a) + squares(b, mean_b)) / degrees;
  if (variance == 0) return 0;
  const double t = std::abs(mean_a - mean_b) / std::sqrt(variance * (1 / n_a + 1 / n_b));
  return 2 * boost::math::cdf(boost::math::complement(boost::math::students_t(degrees), t));
}

}  // namespace hbr::inline statistics
