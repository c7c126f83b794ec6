// Experiments in which several factors change together: which combinations of their levels are run.
#pragma once

#include <vector>

namespace hbr::inline statistics {

using Levels = std::vector<int>;  // of each factor, from 0

// Some of all combinations of factors with these many levels (each 2 or more), in lexicographic order, the
// combination of all zeros among them: all where `runs` is 0 or not less than all. Otherwise rows that agree
// with each other as little as can be found (from random choices, by exchanging rows), by the sum over all
// pairs of rows of (the sum of the levels of the factors in which they agree)^4: the moments whose minimum
// keeps main effects clear of each other and of pairs (Xu 2003, minimum moment aberration). In whole numbers,
// so that every machine finds the same. Throws InputError where there are more than 65 536 combinations.
std::vector<Levels> factorial_design(const std::vector<int>& levels, int runs);

}  // namespace hbr::inline statistics
