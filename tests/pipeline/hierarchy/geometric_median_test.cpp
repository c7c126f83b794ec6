#include "pipeline/hierarchy/geometric_median.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "pipeline/core/random.h"

namespace hbr {
namespace {

template <int D>
using Vector = Eigen::Matrix<double, D, 1>;

template <int D>
double cost(const std::vector<double>& points, const Vector<D>& at) {
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); i += D) sum += (Vector<D>::Map(&points[i]) - at).norm();
  return sum;
}

// A second way: the cost is convex, so where no step in any of many directions lowers it, it is least.
template <int D>
Vector<D> searched(const std::vector<double>& points, Vector<D> at) {
  Rng rng(Seed(29));
  for (double step = 1; step > 1e-9; step /= 2)
    for (int i = 0; i < 60; ++i) {
      Vector<D> direction;
      for (int d = 0; d < D; ++d) direction[d] = rng.uniform(-1, 1);
      const Vector<D> next = at + step * direction;
      if (cost<D>(points, next) < cost<D>(points, at)) at = next;
    }
  return at;
}

template <int D>
Median<D> median_of(const std::vector<double>& points) {
  Samples<D> samples;
  samples.resize(static_cast<int>(points.size() / D));
  for (std::size_t i = 0; i < points.size(); ++i)
    samples.coordinate(i % D)[i / D] = static_cast<float>(points[i]);
  return geometric_median<D>(samples);
}

template <int D>
void agrees_with_a_search() {
  for (int n : {3, 4, 10, 100}) {
    for (int trial = 0; trial < 20; ++trial) {
      Rng rng(Seed(21).child(D).child(n).child(trial));
      std::vector<double> points;
      for (int i = 0; i < n * D; ++i)
        points.push_back(trial % 4 == 3 && i >= D && i < 2 * D ? points[i - D]  // a sample twice
                                                               : rng.uniform());
      const Median<D> median = median_of<D>(points);
      const Vector<D> place = median.point.template cast<double>();
      const Vector<D> expected = searched<D>(points, place);
      EXPECT_LE(cost<D>(points, place), cost<D>(points, expected) + 1e-6 * n) << "n " << n;
      EXPECT_LT((place - expected).norm(), 1e-4) << "n " << n;
      EXPECT_NEAR(median.mean_distance, cost<D>(points, place) / n, 1e-6);
      double least = 1e9;
      for (int i = 0; i < n; ++i) least = std::min(least, (Vector<D>::Map(&points[i * D]) - place).norm());
      EXPECT_NEAR((Vector<D>::Map(&points[median.nearest * D]) - place).norm(), least, 1e-6);
    }
  }
}

TEST(GeometricMedian, AgreesWithASearchOfTheCost) {
  agrees_with_a_search<1>();
  agrees_with_a_search<2>();
  agrees_with_a_search<3>();
  agrees_with_a_search<4>();
}

TEST(GeometricMedian, KnownCases) {
  const std::vector<double> one = {0.3, 0.7};
  EXPECT_EQ(median_of<2>(one).point, Eigen::Vector2f(0.3f, 0.7f));
  EXPECT_EQ(median_of<2>(one).mean_distance, 0);
  // Equilateral triangle: the Fermat point is its centre.
  const double h = std::sqrt(3.0) / 2;
  const std::vector<double> triangle = {0, 0, 1, 0, 0.5, h};
  EXPECT_LT((median_of<2>(triangle).point - Eigen::Vector2f(0.5f, static_cast<float>(h / 3))).norm(), 1e-6);
  // An angle above 120 degrees: the median is that corner, a sample.
  const std::vector<double> flat = {-1, 0, 1, 0, 0, 0.1};
  EXPECT_LT((median_of<2>(flat).point - Eigen::Vector2f(0, 0.1f)).norm(), 1e-6);
  // More than half the samples are one point: it is that point, wherever the others are.
  const std::vector<double> heap = {0.2, 0.2, 0.2, 0.2, 0.2, 0.2, 0.9, 0.1, 0.8, 0.9};
  EXPECT_LT((median_of<2>(heap).point - Eigen::Vector2f(0.2f, 0.2f)).norm(), 1e-6);
  // The mean of these is a sample, but not their median.
  const std::vector<double> trap = {0, 0, 1, 0, -3, 0, 1, 1, 1, -1};
  EXPECT_NEAR(median_of<2>(trap).point.x(), 1 - 1 / std::sqrt(3.0), 1e-5);  // a Fermat point
}

}  // namespace
}  // namespace hbr
