#include "pipeline/hierarchy/geometric_median.h"

#include <algorithm>
#include <limits>

namespace hbr {
namespace {

// The pull of all samples on a place: sum of the unit vectors towards them, and how many are right there.
template <int D>
struct Pull {
  Eigen::Matrix<double, D, 1> force = Eigen::Matrix<double, D, 1>::Zero();
  Eigen::Matrix<double, D, 1> weighted = Eigen::Matrix<double, D, 1>::Zero();  // sum of sample / distance
  double weights = 0;                                                          // sum of 1 / distance
  int here = 0;

  Pull(const double* points, int n, const Eigen::Matrix<double, D, 1>& place) {
    constexpr double kCoincident = 1e-12;
    for (int i = 0; i < n; ++i) {
      const Eigen::Map<const Eigen::Matrix<double, D, 1>> sample(points + D * i);
      const double distance = (sample - place).norm();
      if (distance < kCoincident) {
        ++here;
        continue;
      }
      weights += 1 / distance;
      weighted += sample / distance;
      force += (sample - place) / distance;
    }
  }
  // Samples hold a place with the strength of their number.
  bool holds() const { return here > 0 && force.norm() <= here; }
};

template <int D>
Median<D> with_distances(const double* points, int n, const Eigen::Matrix<double, D, 1>& place) {
  Median<D> out{place, 0, 0};
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < n; ++i) {
    const double distance = (Eigen::Map<const Eigen::Matrix<double, D, 1>>(points + D * i) - place).norm();
    out.mean_distance += distance / n;
    if (distance < least) {
      least = distance;
      out.nearest = i;
    }
  }
  return out;
}

}  // namespace

template <int D>
Median<D> geometric_median(const double* points, int n) {
  using Vector = Eigen::Matrix<double, D, 1>;
  constexpr double kTolerance = 1e-7;
  constexpr int kMostSteps = 1000;

  Vector median = Vector::Zero();
  for (int i = 0; i < n; ++i) median += Vector::Map(points + D * i) / n;
  for (int step = 0; n > 2 && step < kMostSteps; ++step) {
    const Pull<D> pull(points, n, median);
    if (pull.weights == 0 || pull.holds()) break;
    const double keep = pull.here > 0 ? pull.here / pull.force.norm() : 0;
    const Vector next = (1 - keep) * (pull.weighted / pull.weights) + keep * median;
    const double moved = (next - median).norm();
    median = next;
    if (moved < kTolerance) break;
  }
  // The iteration nears a median that is a sample so slowly that it stops short of it.
  const Median<D> found = with_distances<D>(points, n, median);
  const Vector sample = Vector::Map(points + D * found.nearest);
  return n > 2 && Pull<D>(points, n, sample).holds() ? with_distances<D>(points, n, sample) : found;
}

template Median<2> geometric_median<2>(const double*, int);
template Median<3> geometric_median<3>(const double*, int);

}  // namespace hbr
