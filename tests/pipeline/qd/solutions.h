// Solutions drawn at random, to be offered to containers.
#pragma once

#include <vector>

#include "pipeline/core/random.h"
#include "pipeline/qd/elite_store.h"

namespace hbr {

struct Solution {
  std::vector<float> genome, descriptor;
  float fitness;
  std::int64_t id;
  Candidate candidate() const {
    return {genome.data(), static_cast<int>(genome.size()), descriptor.data(), fitness, 0, id, id / 3 - 1};
  }
};

// Three or four genes; a descriptor of d in [-0.05, 1.05]; a fitness between 0 and `sign`.
inline Solution random_solution(Rng& rng, std::int64_t id, int d, float sign) {
  Solution s{{}, {}, sign * rng.uniform(), id};
  for (int i = 0; i < 3 + static_cast<int>(id % 2); ++i) s.genome.push_back(rng.uniform());
  for (int i = 0; i < d; ++i) s.descriptor.push_back(rng.uniform(-0.05f, 1.05f));
  return s;
}

}  // namespace hbr
