#include "pipeline/hierarchy/geometric_median.h"

#include <algorithm>
#include <limits>

namespace hbr {

template <int D>
Median<D> geometric_median(const double* points, int n) {
  using Vector = Eigen::Matrix<double, D, 1>;
  constexpr double kTolerance = 1e-7, kCoincident = 1e-12;
  constexpr int kMostSteps = 1000;
  const auto sample = [&](int i) { return Eigen::Map<const Vector>(points + D * i); };

  Vector median = Vector::Zero();
  for (int i = 0; i < n; ++i) median += sample(i);
  median /= n;
  for (int step = 0; n > 2 && step < kMostSteps; ++step) {
    Vector weighted = Vector::Zero(), pull = Vector::Zero();
    double weights = 0;
    int coincident = 0;
    for (int i = 0; i < n; ++i) {
      const Vector difference = sample(i) - median;
      const double distance = difference.norm();
      if (distance < kCoincident) {
        ++coincident;
        continue;
      }
      weights += 1 / distance;
      weighted += sample(i) / distance;
      pull += difference / distance;
    }
    if (weights == 0) break;  // all samples are here
    // A sample at the current place holds it with the strength of its multiplicity.
    const double force = pull.norm();
    if (coincident > 0 && force <= coincident) break;
    const double keep = coincident > 0 ? coincident / force : 0;
    const Vector next = (1 - keep) * (weighted / weights) + keep * median;
    const double moved = (next - median).norm();
    median = next;
    if (moved < kTolerance) break;
  }

  Median<D> out{median, 0, 0};
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < n; ++i) {
    const double distance = (sample(i) - median).norm();
    out.mean_distance += distance / n;
    if (distance < least) {
      least = distance;
      out.nearest = i;
    }
  }
  return out;
}

template Median<2> geometric_median<2>(const double*, int);
template Median<3> geometric_median<3>(const double*, int);

}  // namespace hbr
