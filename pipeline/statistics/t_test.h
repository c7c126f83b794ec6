// Student's t-test of two samples, for those that are too small for ranks.
#pragma once

#include <span>

namespace hbr::inline statistics {

// Two-sided p-value: that two samples of one normal distribution have means so far apart, by their common
// variance. 0 where the means differ and nothing else does. Of three values at least in all (HBR_CHECK).
double t_test(std::span<const double> a, std::span<const double> b);

}  // namespace hbr::inline statistics
