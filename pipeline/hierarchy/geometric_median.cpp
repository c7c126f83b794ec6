#include "pipeline/hierarchy/geometric_median.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hbr {
namespace {

template <int D>
using Point = Eigen::Matrix<float, D, 1>;

float sum_of_lanes(const float* lanes) {
  float sum = 0;
  for (int l = 0; l < Samples<1>::kLanes; ++l) sum += lanes[l];
  return sum;
}

// How the samples pull at a place.
template <int D>
struct Pull {
  Point<D> force;  // sum of the unit vectors towards the samples
  float weights;   // sum of 1 / distance
  float here;      // samples that are right there: they hold the place with the strength of their number

  Pull(const Samples<D>& samples, const Point<D>& place) {
    constexpr int kLanes = Samples<D>::kLanes;
    constexpr float kCoincident2 = 1e-14f;
    alignas(64) float force_lanes[D][kLanes] = {}, weight_lanes[kLanes] = {}, here_lanes[kLanes] = {};
    for (int g = 0; g < samples.groups(); ++g) {
      const float* present = samples.present() + g * kLanes;
      alignas(64) float offset[D][kLanes], weight[kLanes];
      for (int l = 0; l < kLanes; ++l) {
        float squared = 0;
        for (int d = 0; d < D; ++d) {
          offset[d][l] = samples.coordinate(d)[g * kLanes + l] - place[d];
          squared += offset[d][l] * offset[d][l];
        }
        const bool apart = squared > kCoincident2;
        const float inverse = present[l] / std::sqrt(squared);
        weight[l] = apart ? inverse : 0.0f;
        here_lanes[l] += apart ? 0.0f : present[l];
        weight_lanes[l] += weight[l];
      }
      for (int d = 0; d < D; ++d)
        for (int l = 0; l < kLanes; ++l) force_lanes[d][l] += weight[l] * offset[d][l];
    }
    for (int d = 0; d < D; ++d) force[d] = sum_of_lanes(force_lanes[d]);
    weights = sum_of_lanes(weight_lanes);
    here = sum_of_lanes(here_lanes);
  }

  bool holds() const { return here > 0 && force.norm() <= here; }
};

template <int D>
Median<D> with_distances(const Samples<D>& samples, const Point<D>& place) {
  Median<D> out{place, 0, 0};
  float least = std::numeric_limits<float>::infinity(), sum = 0;
  for (int i = 0; i < samples.size(); ++i) {
    const float distance = (samples.sample(i) - place).norm();
    sum += distance;
    if (distance < least) {
      least = distance;
      out.nearest = i;
    }
  }
  out.mean_distance = sum / static_cast<float>(samples.size());
  return out;
}

}  // namespace

template <int D>
void Samples<D>::resize(int n) {
  if (n == size_) return;
  size_ = n;
  groups_ = (n + kLanes - 1) / kLanes;
  for (auto& values : values_) values.assign(groups_ * kLanes, 0.0f);
  present_.assign(groups_ * kLanes, 0.0f);
  std::fill_n(present_.begin(), n, 1.0f);
}

template <int D>
Median<D> geometric_median(const Samples<D>& samples) {
  constexpr float kTolerance = 1e-6f;
  constexpr int kMostSteps = 1000;
  const int n = samples.size();

  Point<D> median = Point<D>::Zero();
  for (int d = 0; d < D; ++d) {
    for (int i = 0; i < n; ++i) median[d] += samples.coordinate(d)[i];
    median[d] /= static_cast<float>(n);
  }
  if (n <= 2) return with_distances<D>(samples, median);
  for (int step = 0; step < kMostSteps; ++step) {
    const Pull<D> pull(samples, median);
    if (pull.weights == 0 || pull.holds()) break;
    const float drawn = pull.here > 0 ? 1 - pull.here / pull.force.norm() : 1;
    const Point<D> move = pull.force * (drawn / pull.weights);
    median += move;
    if (move.norm() < kTolerance) break;
  }
  // The iteration nears a median that is a sample so slowly that it stops short of it.
  const Median<D> found = with_distances<D>(samples, median);
  const Point<D> sample = samples.sample(found.nearest);
  return Pull<D>(samples, sample).holds() ? with_distances<D>(samples, sample) : found;
}

template class Samples<2>;
template class Samples<3>;
template Median<2> geometric_median<2>(const Samples<2>&);
template Median<3> geometric_median<3>(const Samples<3>&);

}  // namespace hbr
