// The file of claims: every quantitative or visual claim of the paper, where ours comes from, and the rule
// for its verdict. reports/claims.toml says what each key means.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/core/settings.h"

namespace hbr::inline reports {

// A run is large enough where a number is at least so large, or a quantity has at least so many replications.
struct Need {
  std::string of;
  double at_least = 0;
};

struct Size {
  std::string name;
  std::vector<Need> needs;
};

// One comparison; x is
//   value       of: the number, or the median of the quantity
//   ratio       of over to (medians)
//   difference  of less to (medians)
//   a12         the chance that a value of `of` is greater than one of `to`
// It holds where x lies in `reproduced` and the rank-sum test gives p < p_below, adjusted for the tests of
// all claims (Holm 1979); it holds in part where x lies in `partly` and the adjusted p is below 0.05 (or
// p_below where that is greater), and is undecided where x lies there and p is not.
struct Check {
  std::string words;  // what is compared, for the reader
  std::string kind, of, to;
  std::vector<double> reproduced, partly;  // low, high (may be infinite), inclusive
  double p_below = 1;                      // 1 or more: no test
};

struct Claim {
  std::string id, place;
  std::string statement;   // in our words
  std::string quote;       // a few of the paper's, or ""
  std::string paper;       // its figures
  std::string size;        // name of a Size, or ""
  std::string decided_by;  // "result"; "design": the experiment's settings, whatever comes out; "ours": not
                           // the paper's
  std::vector<Check> checks;
};

struct ClaimFile {
  std::vector<Size> sizes;
  std::vector<Claim> claims;
};

// Throws InputError: file, line, what was expected and found. Names of statistics must be in the vocabulary
// (pipeline/statistics/names.h), ids unique, sizes defined, ranges in order.
ClaimFile read_claim_file(const std::filesystem::path& path);

}  // namespace hbr::inline reports
