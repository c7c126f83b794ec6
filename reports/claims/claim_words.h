// What was found about a claim, as sentences made from numbers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pipeline/statistics/inference.h"
#include "reports/claims/claim_file.h"

namespace hbr::inline reports {

// A statistic as claims see it: a number has no values.
struct Statistic {
  std::string unit;
  double median = 0, q1 = 0, q3 = 0;
  std::vector<double> values;
};

enum class CheckOutcome { absent, yes, partly, no, undecided };
const char* outcome_name(CheckOutcome outcome);

struct Measured {
  CheckOutcome outcome = CheckOutcome::absent;
  std::string absent;  // what is missing, where something is
  Statistic of, to;
  std::optional<double> x, p, a12;
  std::optional<double> p_together;  // p, adjusted for the tests of all claims, which are read together
  // Whether p is the least that so few replications can give, which no adjustment could make small enough.
  bool least_p = false;
  std::optional<Interval> interval;  // of x, at kConfidence
  // Of a test that does not decide though x is as asked: with how many replications it might.
  std::optional<int> would_tell;
};

struct NeedFound {
  Need need;
  std::optional<double> found;
  std::string unit;
  bool met = false;
};

// The p-value that decides, adjusted for all tests that do unless it is the least that there can be, where
// there are kFewestToTest replications of both.
std::optional<double> shown_p(const Measured& measured);
// What was found, with the replications: "325 times (50 000 elites against 154), n = 50"; or what is missing.
std::string check_ours(const Check& check, const Measured& measured);
// When it counts as reproduced: "at least 100 times and p < 0.05".
std::string check_asked(const Check& check, const Measured& measured);
// "325 times", "A12 0.98": what was computed; only where it was.
std::string check_figure(const Check& check, const Measured& measured);
// The figures alone.
std::string ours_in_words(const Claim& claim, const std::vector<Measured>& measured,
                          const std::vector<NeedFound>& needs);
// What is too small, if anything is, and how many checks hold.
std::string reason(const std::vector<Measured>& measured, const std::vector<NeedFound>& needs,
                   const std::string& indication);

}  // namespace hbr::inline reports
