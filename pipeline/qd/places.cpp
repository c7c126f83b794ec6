#include "pipeline/qd/places.h"

#include <algorithm>
#include <cmath>

namespace hbr::inline qd {

NearestElites nearest_elites(const Rows& places, const Elites& elites) {
  NearestElites found;
  for (Eigen::Index i = 0; i < places.rows(); ++i) {
    Eigen::Index nearest = 0;
    const float squared =
        (elites.measures.rowwise() - places.row(i)).rowwise().squaredNorm().minCoeff(&nearest);
    found.elite.push_back(static_cast<std::int32_t>(nearest));
    found.distance.push_back(std::sqrt(squared));
  }
  return found;
}

Rows places_beside(const Rows& places, double by, Seed seed) {
  Rng rng(seed);
  const auto most = static_cast<float>(by);
  Rows moved = places;
  for (float& coordinate : moved.reshaped<Eigen::RowMajor>())
    coordinate = std::clamp(coordinate + rng.uniform(-most, most), 0.0f, 1.0f);
  return moved;
}

}  // namespace hbr::inline qd
