// Readings of what the paper leaves open, taken together: the combinations of a profile's table [readings] as
// variations, and the stage that compares them.
#pragma once

#include "pipeline/artifact/graph.h"
#include "stages/plan/profile.h"

namespace hbr::inline stages {

struct Combination {
  std::string name;         // of the variation, "readings_0120": the place of each reading's value
  std::vector<int> levels;  // these places; all 0: the plain run
};

// Those to run, the plain one first; none where the table names no readings. Throws InputError, `file` in
// front, where a reading is none of the ledger's, stands twice, or has fewer than two or more than ten
// values, or two by one name.
std::vector<Combination> combinations_of(const std::string& file, const ReadingsTable& readings);

// The stage `readings`: of statistics that the graph has.
Node readings_stage(const ReadingsTable& readings, const std::vector<Combination>& combinations);

}  // namespace hbr::inline stages
