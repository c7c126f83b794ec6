// Readings of what the paper leaves open, taken together: each combination that was run, how far it is from
// all of the paper's figures at once, and which readings move each figure and each claim.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace hbr::inline reports {

struct StudiedReading {
  std::string id;                   // in reports/readings.toml
  std::vector<std::string> values;  // the first is that of the plain run
};

struct StudiedRun {
  std::vector<int> levels;    // the value of each reading
  std::string name;           // of the variation; "" for the plain run
  nlohmann::json statistics;  // statistics.json
};

// The contents of readings.json:
//   readings  [{id, values}]
//   runs      [{name, levels, distances: of each figure (null where it could not be computed), distance: of
//             all (null likewise), claims: how many it {reproduced, partly, undecided, not}}], in order of
//             the combinations
//   nearest   place among the runs, the least distance first; of equals, and where the readings move none of
//             the figures, the one that reproduces more claims, then the one that contradicts fewer
//   figures   [{id, place, words, median, quartiles, x: of each run (null ...), moved}] of those that differ
//             between the runs
//   claims    [{id, statement, place, verdicts: the indication of each run, checks: [{words, x, moved}]}], of
//             claims that a result decides and that any run can answer
// `moved` is null where a run has no x, otherwise the analysis of variance of x (of ln x where all are
// positive; what is multiplied by a reading is then moved alike by it whatever the others are) over the
// readings: {logarithm, terms: [{readings: places of one or two, share, degrees, p (null ...)}], effects:
// [reading][value], unexplained, runs: how many differ} (pipeline/statistics/factorial.h).
// Throws InputError where a file or statistics are not as described.
nlohmann::json study_readings(const std::vector<StudiedReading>& readings,
                              const std::vector<StudiedRun>& runs, const std::filesystem::path& figures,
                              const std::filesystem::path& claims);

}  // namespace hbr::inline reports
