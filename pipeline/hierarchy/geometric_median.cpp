#include "pipeline/hierarchy/geometric_median.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace hbr::inline hierarchy {
namespace {

template <int D>
using Point = Eigen::Matrix<float, D, 1>;

constexpr int kLanes = Samples<1>::kLanes;
using Lanes [[gnu::vector_size(kLanes * sizeof(float))]] = float;

Lanes load(const float* from) {
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}

// 1 / sqrt(x) to a float's precision, x positive: a guess from the exponent (Lomont 2003) and three steps of
// Newton, in a third of the time that a root and a division take.
Lanes inverse_root(Lanes x) {
  using IntLanes [[gnu::vector_size(kLanes * sizeof(std::int32_t))]] = std::int32_t;
  IntLanes bits;
  std::memcpy(&bits, &x, sizeof x);
  bits = 0x5f375a86 - (bits >> 1);
  Lanes y;
  std::memcpy(&y, &bits, sizeof y);
  const Lanes half = 0.5f * x;
  for (int step = 0; step < 3; ++step) y = y * (1.5f - half * y * y);
  return y;
}

// Halves added to halves: the order does not depend on the width of the machine's vectors.
template <int kWidth>
float sum_of_halves(const float* lanes) {
  if constexpr (kWidth == 1) {
    return *lanes;
  } else {
    using Half [[gnu::vector_size(kWidth / 2 * sizeof(float))]] = float;
    Half low, high;
    std::memcpy(&low, lanes, sizeof low);
    std::memcpy(&high, lanes + kWidth / 2, sizeof high);
    low += high;
    return sum_of_halves<kWidth / 2>(reinterpret_cast<const float*>(&low));
  }
}
float sum_of_lanes(const Lanes& lanes) {
  return sum_of_halves<kLanes>(reinterpret_cast<const float*>(&lanes));
}

// How the samples pull at a place.
template <int D>
struct Pull {
  Point<D> force;                     // sum of the unit vectors towards the samples
  Eigen::Matrix<float, D, D> spread;  // sum of their outer products over the distance
  float weights;                      // sum of 1 / distance
  float cost;                         // sum of the distances, which the median makes least
  float here;  // samples that are right there: they hold the place with the strength of their number

  [[gnu::always_inline]] Pull(const Samples<D>& samples, const Point<D>& place) {
    constexpr float kCoincident2 = 1e-14f;
    constexpr int kPairs = D * (D + 1) / 2;
    Lanes force_lanes[D] = {}, spread_lanes[kPairs] = {}, weight_lanes = {}, cost_lanes = {}, here_lanes = {};
    const Lanes none = {};
    for (int g = 0; g < samples.groups(); ++g) {
      const Lanes present = load(samples.present() + g * kLanes);
      Lanes offset[D], squared = none;
      for (int d = 0; d < D; ++d) {
        offset[d] = load(samples.coordinate(d) + g * kLanes) - place[d];
        squared += offset[d] * offset[d];
      }
      const auto apart = squared > kCoincident2;
      const Lanes weight = apart ? present * inverse_root(squared) : none;
      weight_lanes += weight;
      cost_lanes += weight * squared;
      here_lanes += apart ? none : present;
      for (int d = 0, pair = 0; d < D; ++d) {
        const Lanes unit = weight * offset[d];
        force_lanes[d] += unit;
        for (int c = 0; c <= d; ++c, ++pair) spread_lanes[pair] += unit * (weight * offset[c]) * weight;
      }
    }
    for (int d = 0, pair = 0; d < D; ++d) {
      force[d] = sum_of_lanes(force_lanes[d]);
      for (int c = 0; c <= d; ++c, ++pair) spread(d, c) = spread(c, d) = sum_of_lanes(spread_lanes[pair]);
    }
    weights = sum_of_lanes(weight_lanes);
    cost = sum_of_lanes(cost_lanes);
    here = sum_of_lanes(here_lanes);
  }

  // Whether the place is the median, being a sample.
  bool holds() const { return here > 0 && force.norm() <= here; }

  // Nearer to the median; where the costs agree to their last bits, the pull tells.
  bool better_than(const Pull& other) const {
    constexpr float kRounding = 1e-6f;
    return cost < (1 - kRounding) * other.cost ||
           (cost < (1 + kRounding) * other.cost && force.squaredNorm() < 0.25f * other.force.squaredNorm());
  }

  // Weiszfeld's step; at a sample, that of Vardi and Zhang. It never leads uphill.
  Point<D> safe_step() const {
    const float drawn = here > 0 ? 1 - here / force.norm() : 1;
    return force * (drawn / weights);
  }

  // Newton's step, or nothing to speak of where the sum of distances is as good as flat in some direction.
  bool newton_step(Point<D>& step) const {
    const Eigen::Matrix<float, D, D> curvature = weights * Eigen::Matrix<float, D, D>::Identity() - spread;
    const float least = 1e-4f * weights * weights * (D > 2 ? weights : 1);
    if constexpr (D > 3) {
      step = force;
      return here == 0 && eliminate(curvature, step) > least;
    } else {
      if (here > 0 || !(curvature.determinant() > least)) return false;
      step = curvature.inverse() * force;
      return true;
    }
  }

  // Solves matrix * x = right, leaves x in `right` and returns the determinant; the matrix is positive
  // definite, so that no pivot is sought. Eigen's own way for four rows has fused multiply-adds where the
  // processor has them: other bytes on other machines.
  static float eliminate(Eigen::Matrix<float, D, D> matrix, Point<D>& right) {
    float determinant = 1;
    for (int pivot = 0; pivot < D; ++pivot) {
      determinant *= matrix(pivot, pivot);
      for (int row = pivot + 1; row < D; ++row) {
        const float factor = matrix(row, pivot) / matrix(pivot, pivot);
        for (int column = pivot + 1; column < D; ++column)
          matrix(row, column) -= factor * matrix(pivot, column);
        right[row] -= factor * right[pivot];
      }
    }
    for (int row = D - 1; row >= 0; --row) {
      for (int column = row + 1; column < D; ++column) right[row] -= matrix(row, column) * right[column];
      right[row] /= matrix(row, row);
    }
    return determinant;
  }
};

template <int D>
Lanes squared_distances(const Samples<D>& samples, int group, const Point<D>& place) {
  Lanes sum = {};
  for (int d = 0; d < D; ++d) {
    const Lanes offset = load(samples.coordinate(d) + group * kLanes) - place[d];
    sum += offset * offset;
  }
  return sum;
}

template <int D>
int nearest_sample(const Samples<D>& samples, const Point<D>& place) {
  int nearest = 0;
  float least = std::numeric_limits<float>::infinity();
  for (int g = 0; g < samples.groups(); ++g) {
    alignas(sizeof(Lanes)) float squared[kLanes];
    const Lanes lanes = squared_distances<D>(samples, g, place);
    std::memcpy(squared, &lanes, sizeof lanes);
    for (int l = 0; l < kLanes && g * kLanes + l < samples.size(); ++l) {
      nearest = squared[l] < least ? g * kLanes + l : nearest;
      least = squared[l] < least ? squared[l] : least;
    }
  }
  return nearest;
}

template <int D>
Median<D> with_distances(const Samples<D>& samples, const Point<D>& place) {
  constexpr float kTiny = 1e-30f;  // something under the root
  Lanes distances = {};
  for (int g = 0; g < samples.groups(); ++g) {
    const Lanes squared = squared_distances<D>(samples, g, place);
    distances += load(samples.present() + g * kLanes) * squared * inverse_root(squared + kTiny);
  }
  return {place, sum_of_lanes(distances) / static_cast<float>(samples.size()),
          nearest_sample(samples, place)};
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
  constexpr int kMaxSteps = 1000, kFirstSteps = 2, kMaxHalvings = 2;
  const int n = samples.size();

  Point<D> place = Point<D>::Zero();
  for (int d = 0; d < D; ++d) {
    for (int i = 0; i < n; ++i) place[d] += samples.coordinate(d)[i];
    place[d] /= static_cast<float>(n);
  }
  if (n <= 2) return with_distances<D>(samples, place);

  // A median that is a sample is neared slowly, or in circles: the sample nearest to the place is tried,
  // once.
  int tried = -1;
  const auto nearest_holds = [&] {
    const int nearest = nearest_sample(samples, place);
    if (nearest == tried) return false;
    tried = nearest;
    const Point<D> sample = samples.sample(nearest);
    if (!Pull<D>(samples, sample).holds()) return false;
    place = sample;
    return true;
  };

  Pull<D> pull(samples, place);
  for (int step = 1; step <= kMaxSteps; ++step) {
    if (pull.weights == 0 || pull.holds()) break;
    Point<D> move;
    bool newton = step > kFirstSteps && pull.newton_step(move);
    for (int halvings = 0; newton; ++halvings, move /= 2) {
      const Pull<D> there(samples, place + move);
      if (there.better_than(pull) || move.norm() < kTolerance) {
        place += move;
        pull = there;
        break;
      }
      newton = halvings < kMaxHalvings;
    }
    if (!newton) {
      if (step >= kFirstSteps && nearest_holds()) break;
      move = pull.safe_step();
      place += move;
      pull = Pull<D>(samples, place);
    }
    if (move.norm() < kTolerance) {
      if (newton) return with_distances<D>(samples, place);  // no pull left: that is the median
      break;
    }
  }
  nearest_holds();
  return with_distances<D>(samples, place);
}

template class Samples<1>;
template class Samples<2>;
template class Samples<3>;
template class Samples<4>;
template Median<1> geometric_median<1>(const Samples<1>&);
template Median<2> geometric_median<2>(const Samples<2>&);
template Median<3> geometric_median<3>(const Samples<3>&);
template Median<4> geometric_median<4>(const Samples<4>&);

}  // namespace hbr::inline hierarchy
