#include "pipeline/statistics/rank_sum.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <utility>
#include <vector>

#include "pipeline/core/check.h"

namespace hbr::inline statistics {
namespace {

struct Ranked {
  double rank_sum_a = 0;             // ties share their mean rank
  double ties = 0;                   // sum of t^3 - t over groups of t equal values
  std::vector<std::size_t> doubled;  // rank times two of each value in order: whole with ties, too
};

Ranked rank(std::span<const double> a, std::span<const double> b) {
  std::vector<std::pair<double, bool>> values;  // value, is from a
  values.reserve(a.size() + b.size());
  for (const double value : a) values.emplace_back(value, true);
  for (const double value : b) values.emplace_back(value, false);
  std::ranges::sort(values);

  Ranked result;
  for (std::size_t begin = 0, end = 0; begin < values.size(); begin = end) {
    double from_a = 0;
    for (end = begin; end < values.size() && values[end].first == values[begin].first; ++end)
      from_a += values[end].second ? 1 : 0;
    const auto t = static_cast<double>(end - begin);
    result.rank_sum_a += from_a * 0.5 * static_cast<double>(begin + 1 + end);
    result.ties += t * t * t - t;
    result.doubled.insert(result.doubled.end(), end - begin, begin + 1 + end);
  }
  return result;
}

double normal_p(double u, double n_a, double n_b, double ties) {
  const double n = n_a + n_b;
  const double variance = n_a * n_b / 12 * (n + 1 - ties / (n * (n - 1)));
  if (!(variance > 0)) return 1;
  const double distance = std::max(0.0, std::abs(u - n_a * n_b / 2) - 0.5);
  const boost::math::normal standard;
  return std::min(1.0, 2 * cdf(complement(standard, distance / std::sqrt(variance))));
}

// Number of ways to choose which n_a of the n_a + n_b ranks belong to a, by the U they give. The greatest
// value is either from a, and beats all n_b of b, or from b: only sums of positive numbers, so doubles lose
// no digits.
std::vector<double> arrangements(std::size_t n_a, std::size_t n_b) {
  const std::size_t size = n_a * n_b + 1;
  std::vector<std::vector<double>> counts(n_a + 1, std::vector<double>(size));  // [of a][u], for b so far
  for (auto& row : counts) row[0] = 1;
  for (std::size_t b = 1; b <= n_b; ++b)
    for (std::size_t i = 1; i <= n_a; ++i)
      for (std::size_t u = b; u <= i * b; ++u) counts[i][u] += counts[i - 1][u - b];
  return counts[n_a];
}

double exact_p(double u, std::size_t n_a, std::size_t n_b) {
  const std::vector<double> counts = arrangements(n_a, n_b);
  const auto nearer_tail = static_cast<std::size_t>(std::min(u, static_cast<double>(n_a * n_b) - u));
  double tail = 0, all = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    all += counts[i];
    if (i <= nearer_tail) tail += counts[i];
  }
  return std::min(1.0, 2 * tail / all);
}

// With ties: of all ways to choose which n_a of the values are a's, the share whose sum of ranks is as far
// from its mean as this one, or farther.
double exact_p_tied(const Ranked& ranked, std::size_t n_a) {
  const std::size_t n = ranked.doubled.size(), greatest = n * (n + 1);
  // [values chosen][doubled sum]
  std::vector<std::vector<double>> ways(n_a + 1, std::vector<double>(greatest + 1));
  ways[0][0] = 1;
  for (const std::size_t rank : ranked.doubled)
    for (std::size_t k = n_a; k >= 1; --k)
      for (std::size_t sum = greatest; sum >= rank; --sum) ways[k][sum] += ways[k - 1][sum - rank];
  const double mean = static_cast<double>(n_a * (n + 1)), distance = std::abs(2 * ranked.rank_sum_a - mean);
  double tails = 0, all = 0;
  for (std::size_t sum = 0; sum <= greatest; ++sum) {
    all += ways[n_a][sum];
    if (std::abs(static_cast<double>(sum) - mean) >= distance) tails += ways[n_a][sum];
  }
  return tails / all;
}

void check_sample(std::span<const double> values) {
  if (values.empty()) throw InputError("rank-sum test: a sample is empty; expected at least one value");
  for (const double value : values)
    if (!std::isfinite(value))
      throw InputError("rank-sum test: a value is {}; expected finite numbers", value);
}

}  // namespace

RankSum rank_sum(std::span<const double> a, std::span<const double> b) {
  check_sample(a);
  check_sample(b);
  const auto n_a = static_cast<double>(a.size()), n_b = static_cast<double>(b.size());
  const Ranked ranked = rank(a, b);
  RankSum result;
  result.u = ranked.rank_sum_a - n_a * (n_a + 1) / 2;
  result.a12 = result.u / (n_a * n_b);
  result.p_normal = normal_p(result.u, n_a, n_b, ranked.ties);
  const std::size_t n = a.size() + b.size();
  if (ranked.ties == 0 && n <= kExactLimit) result.p_exact = exact_p(result.u, a.size(), b.size());
  if (ranked.ties > 0 && n <= kSmall) result.p_exact = exact_p_tied(ranked, a.size());
  result.p = n <= kSmall ? *result.p_exact : result.p_normal;
  return result;
}

double effect_size(std::span<const double> a, std::span<const double> b) {
  check_sample(a);
  check_sample(b);
  const auto n_a = static_cast<double>(a.size()), n_b = static_cast<double>(b.size());
  return (rank(a, b).rank_sum_a - n_a * (n_a + 1) / 2) / (n_a * n_b);
}

double least_p(std::size_t n_a, std::size_t n_b) {
  if (n_a + n_b <= kSmall) return exact_p(0, n_a, n_b);
  return normal_p(0, static_cast<double>(n_a), static_cast<double>(n_b), 0);
}

}  // namespace hbr::inline statistics
