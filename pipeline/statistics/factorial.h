// What of a response each factor of an experiment, and each two together, explain.
#pragma once

#include <optional>
#include <vector>

#include "pipeline/statistics/factorial_design.h"

namespace hbr::inline statistics {

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
  int runs = 0;                              // without copies
};

// Analysis of variance by least squares, each term beside all others (sums of squares of type III, levels
// coded so that they sum to zero). One response for each run, all finite; of a constant one nothing is
// explained. Runs that differ in a factor on which the response never hangs, to the last bit, are copies of
// each other: they count once, as the evidence that they are, and that factor explains nothing.
FactorialAnalysis analyse_factorial(const std::vector<int>& levels, const std::vector<Levels>& runs,
                                    const std::vector<double>& response);

}  // namespace hbr::inline statistics
