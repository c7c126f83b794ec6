// What every slice of a replicated stage begins with, and the seed of the run.
#pragma once

#include <cstdint>

#include "pipeline/artifact/stage.h"
#include "pipeline/core/random.h"

namespace hbr::inline artifact {

inline constexpr double kMaxReplications = 999;

template <class Fields>
void describe_seed(Fields& f, std::uint64_t& seed) {
  f.number("seed", seed, Range{0, 9007199254740991.0},
           "master seed");  // 2^53 - 1, exact in every JSON reader
}

struct RunTable {
  std::uint64_t seed = 0;
  int replication = 0;
};
template <class Fields>
void describe_run(Fields& f, RunTable& s) {
  describe_seed(f, s.seed);
  f.number("replication", s.replication, Range{0, kMaxReplications - 1}, "replication, from 0");
}
// From the master seed by the stage's name and the replication.
inline Seed seed_of(const StageRun& stage, const RunTable& s) {
  return Seed(s.seed).child(stage.stage()).child(s.replication);
}

}  // namespace hbr::inline artifact
