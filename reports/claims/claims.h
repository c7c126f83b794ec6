// The paper's claims, decided by a run's statistics.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace hbr::inline reports {

// `claims` is reports/claims.toml, `statistics` the contents of statistics.json
// (pipeline/statistics/table.h). Returns claims.json, an array in the file's order of
//
//   id, place, statement, quote, paper, decided_by   as in the file
//   ours        this run's figures, in words
//   verdict     "reproduced" (every check holds), "partly" (some do, or in part), "not" (none does, and one
//               fails), "undecided" (none does, as the tests do not tell from chance what was found), "not at
//               this size" (the run is too small for the claim, or lacks what it is about). Checks that equal
//               samples would meet count as some only in a claim of nothing else.
//   indication  what the verdict would be without regard to size; "" where nothing was measured. A p-value
//               below 0.05 is then only asked to be as small as the test can give for so few replications.
//   reason      what is too small, and how many checks hold
//   sources     names of the statistics used
//   checks      [{words, kind, of, to, reproduced, partly, p_below, asked, ours, x, figure, p, p_alone, a12,
//               would_tell, interval, outcome}]:
//               asked and ours say in words when it counts as reproduced and what was found; outcome is
//               "yes", "partly", "no", "undecided" or "absent"; x, figure (x in its unit), p (of
//               kFewestToTest replications and more), a12 and interval (of x at kConfidence, by bootstrap)
//               where there are such; infinite ends are null. Where p decides it is adjusted for the tests of
//               all claims (inference.h), unless it is the least that so few replications can give, and
//               p_alone is what it was; would_tell, where p alone is not as asked, says how many replications
//               of each might decide, were the effect what it seems to be
//   needs       [{of, at_least, found, met}], found is null where the statistic is absent
//
// Throws InputError where the file or the statistics are not as described.
nlohmann::json evaluate_claims(const std::filesystem::path& claims, const nlohmann::json& statistics);

}  // namespace hbr::inline reports
