// Whether a run is what a reference run was.
#pragma once

#include <string>
#include <vector>

#include "reports/kept/kept_run.h"

namespace hbr::inline reports {

struct Verification {
  std::vector<std::string> differences;  // one line each
  std::vector<std::string> notes;        // what could not be compared, or needs a word
  std::string summary;
};

// Made by one and the same toolchain the two must agree bit for bit: artifacts, every value of every
// replication that both have, every number, every verdict.
//
// Otherwise within intervals: what is counted by the settings (evaluations, generations, genes, ...) must be
// equal; of every other quantity the two samples must pass the rank-sum test at 1 % shared among all that are
// tested so (Bonferroni), or, where so few replications can't fail it, Student's t-test at the same level.
// Two replications tell nothing: how many quantities and numbers have no more is a note. What class a number
// names is not compared. Numbers with an interval must have intervals that overlap; others that were measured
// once must be within 10 %, those that are shares within 0.02 (2 points). Verdicts follow from these: another
// one is a note.
//
// Runs of which nothing can be compared differ. A quantity that only one of them has is a note where the
// other has none of its kind (the digits of a run without digits), a difference where a single one is missing
// from the run.
Verification verify(const KeptRun& reference, const KeptRun& run);

}  // namespace hbr::inline reports
