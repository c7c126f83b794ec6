// What many tests and few replications leave uncertain: p-values of tests that are read together, confidence
// intervals of effect sizes, and how many replications would tell.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace hbr::inline statistics {

// Holm's step-down adjustment (1979): the least level at which each of the tests, read together, would be
// significant. In the order given, at most 1.
std::vector<double> adjusted_together(std::span<const double> p);

struct Interval {
  double low, high;
};

inline constexpr double kConfidence = 0.95;
inline constexpr int kResamples = 2000;

// Percentile interval (Efron 1979) of what `effect` computes from two samples, each drawn anew with
// replacement; the second may be empty. `name` seeds the draws: the same name and samples give the same
// interval. Both ends are NaN where the effect of some draw is (the ratio of two zeros). Throws InputError
// where the first sample is empty.
using Effect = std::function<double(std::span<const double>, std::span<const double>)>;
Interval bootstrap(std::span<const double> a, std::span<const double> b, const Effect& effect,
                   std::string_view name);

inline constexpr double kPower = 0.8;
inline constexpr int kMostToTell = 1'000'000;

// Replications of each of two samples with which a rank-sum test at `level` tells their difference with a
// chance of kPower, were the effect size A12 what it seems to be (Noether 1987); nothing where that is 1/2,
// or so near to it that more than kMostToTell would be needed.
std::optional<int> replications_to_tell(double a12, double level);

}  // namespace hbr::inline statistics
