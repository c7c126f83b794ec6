// Places in a descriptor space, and the elites nearest to them.
#pragma once

#include <vector>

#include "pipeline/core/random.h"
#include "pipeline/qd/elites.h"

namespace hbr::inline qd {

struct NearestElites {
  std::vector<std::int32_t> elite;  // [n]
  std::vector<float> distance;      // [n] in units of the descriptor
};

// Of each place [n x d] the nearest of the elites, which are not none; of several the first.
NearestElites nearest_elites(const Rows& places, const Elites& elites);

// The places [n x d], each coordinate moved by up to `by` and within [0, 1].
Rows places_beside(const Rows& places, double by, Seed seed);

}  // namespace hbr::inline qd
