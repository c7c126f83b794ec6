#include "pipeline/hierarchy/geometric_median.h"

#include <gtest/gtest.h>

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

// A second way: subgradient-free pattern search on the convex cost, down to steps of 1e-9.
template <int D>
Vector<D> searched(const std::vector<double>& points) {
  Vector<D> at = Vector<D>::Map(points.data());
  for (double step = 1; step > 1e-9;) {
    bool better = false;
    for (int d = 0; d < D; ++d)
      for (const double sign : {-1.0, 1.0}) {
        Vector<D> next = at;
        next[d] += sign * step;
        if (cost<D>(points, next) < cost<D>(points, at)) at = next, better = true;
      }
    if (!better) step /= 2;
  }
  return at;
}

template <int D>
void agrees_with_a_search() {
  for (int n : {3, 4, 10, 100}) {
    for (int trial = 0; trial < 20; ++trial) {
      Rng rng(Seed(21).child(D).child(n).child(trial));
      std::vector<double> points;
      for (int i = 0; i < n * D; ++i)
        points.push_back(trial % 4 == 3 && i >= D && i < 2 * D ? points[i - D]  // a sample twice
                                                               : rng.uniform_double());
      const Median<D> median = geometric_median<D>(points.data(), n);
      const Vector<D> expected = searched<D>(points);
      EXPECT_LE(cost<D>(points, median.point), cost<D>(points, expected) + 1e-8 * n) << "n " << n;
      EXPECT_LT((median.point - expected).norm(), 3e-5) << "n " << n;
      EXPECT_NEAR(median.mean_distance, cost<D>(points, median.point) / n, 1e-12);
      double least = 1e9;
      for (int i = 0; i < n; ++i)
        least = std::min(least, (Vector<D>::Map(&points[i * D]) - median.point).norm());
      EXPECT_EQ((Vector<D>::Map(&points[median.nearest * D]) - median.point).norm(), least);
    }
  }
}

TEST(GeometricMedian, AgreesWithASearchOfTheCost) {
  agrees_with_a_search<2>();
  agrees_with_a_search<3>();
}

TEST(GeometricMedian, KnownCases) {
  const double one[2] = {0.3, 0.7};
  EXPECT_EQ(geometric_median<2>(one, 1).point, Eigen::Vector2d(0.3, 0.7));
  EXPECT_EQ(geometric_median<2>(one, 1).mean_distance, 0);
  // Equilateral triangle: the Fermat point is its centre.
  const double h = std::sqrt(3.0) / 2;
  const double triangle[6] = {0, 0, 1, 0, 0.5, h};
  EXPECT_LT((geometric_median<2>(triangle, 3).point - Eigen::Vector2d(0.5, h / 3)).norm(), 1e-6);
  // An angle above 120 degrees: the median is that corner, a sample.
  const double flat[6] = {-1, 0, 1, 0, 0, 0.1};
  EXPECT_LT((geometric_median<2>(flat, 3).point - Eigen::Vector2d(0, 0.1)).norm(), 1e-6);
  // More than half the samples are one point: it is that point, wherever the others are.
  const double heap[10] = {0.2, 0.2, 0.2, 0.2, 0.2, 0.2, 0.9, 0.1, 0.8, 0.9};
  EXPECT_LT((geometric_median<2>(heap, 5).point - Eigen::Vector2d(0.2, 0.2)).norm(), 1e-6);
  // The mean of these is a sample, but not their median.
  const double trap[10] = {0, 0, 1, 0, -3, 0, 1, 1, 1, -1};
  EXPECT_NEAR(geometric_median<2>(trap, 5).point.x(), 1 - 1 / std::sqrt(3.0), 1e-6);  // a Fermat point
}

}  // namespace
}  // namespace hbr
