// Experiments in which several factors change together: which combinations of their levels are run, and what
// of a response each factor, and each two together, explain.
#pragma once

#include <optional>
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

// What a factor explains, or two together beyond what each does alone.
struct Term {
  std::vector<int> factors;  // one or two
  int degrees = 0;           // of freedom; 0: the runs do not tell it from other terms
  double share = 0;          // of the sum of squares about the mean
  std::optional<double> p;   // F-test against what no term explains, where anything is left to test against
};

struct FactorialAnalysis {
  std::vector<Term> terms;                   // factors alone, then pairs where there are runs enough for them
  std::vector<std::vector<double>> effects;  // [factor][level] of the response, less that of level 0
  double unexplained = 0;                    // share of the sum of squares
};

// Analysis of variance by least squares, each term beside all others (sums of squares of type III, levels
// coded so that they sum to zero). One response for each run, all finite; of a constant one nothing is
// explained.
FactorialAnalysis analyse_factorial(const std::vector<int>& levels, const std::vector<Levels>& runs,
                                    const std::vector<double>& response);

}  // namespace hbr::inline statistics
