// Spearman's rank correlation (1904): do two judges put the same things in the same order?
#pragma once

#include <span>

namespace hbr::inline statistics {

// Pearson's correlation of the ranks, equal values sharing the mean of theirs; in [-1, 1]. 0 where one of
// them says the same of all. Throws InputError where the lengths differ, are less than 2, or a value is not
// finite.
double rank_correlation(std::span<const double> a, std::span<const double> b);

}  // namespace hbr::inline statistics
