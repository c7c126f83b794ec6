// The two-sided rank-sum test (Wilcoxon 1945; Mann and Whitney 1947) and the effect size A12 (Vargha and
// Delaney 2000).
#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace hbr::inline statistics {

struct RankSum {
  double u = 0;  // pairs in which a is greater, ties counting one half; in [0, n_a n_b]
  // The p-value that is told and that decides: the exact one where n_a + n_b <= kSmall, else the
  // approximation.
  double p = 1;
  // Normal approximation with the variance corrected for ties and the statistic for continuity: the test
  // whose value for 50 wholly separate from 50 is 7.066e-18. 1 where all values are equal.
  double p_normal = 1;
  // From the exact distribution of U over all ways to share out the values: where n_a + n_b <= kSmall, and
  // without ties where n_a + n_b <= kExactLimit.
  std::optional<double> p_exact;
  // P(a > b) + P(a = b) / 2: 1 where a is always greater, 0.5 where neither is.
  double a12 = 0.5;
};

inline constexpr std::size_t kExactLimit = 200;
// Above, the approximation is as good as anybody needs, and it is what the paper tells.
inline constexpr std::size_t kSmall = 40;
// A test of fewer values on either side says nothing that could be shown: two against two give 1/3 at least.
inline constexpr std::size_t kFewestToTest = 3;

// Throws InputError where a sample is empty or a value is not finite.
RankSum rank_sum(std::span<const double> a, std::span<const double> b);

// Its A12 alone.
double effect_size(std::span<const double> a, std::span<const double> b);

// The least p that samples of these sizes can give, without ties.
double least_p(std::size_t n_a, std::size_t n_b);

}  // namespace hbr::inline statistics
