#include "pipeline/qd/cvt_archive.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hbr {
namespace {

// Mean squared distance of places in the box to the nearest centre.
double quantisation_error(const Rows& centroids, Rng& rng) {
  double sum = 0;
  constexpr int kPlaces = 20000;
  for (int i = 0; i < kPlaces; ++i) {
    const Eigen::RowVectorXf place =
        Eigen::RowVectorXf::NullaryExpr(centroids.cols(), [&] { return rng.uniform(); });
    sum += (centroids.rowwise() - place).rowwise().squaredNorm().minCoeff();
  }
  return sum / kPlaces;
}

// Of n cells of a plane, hexagons have the least error, 5 / (36 sqrt(3)) of their area squared over n; random
// centres 1 / pi. k-means comes near the former; it
// pays a little at the border and for knowing the box by samples.
TEST(CvtCentroids, AreAlmostAsGoodAsHexagons) {
  constexpr int kCells = 400;
  Rng rng(Seed(21));
  const double hexagons = 2 * 5 / (36 * std::sqrt(3.0)) / kCells;
  const double error = quantisation_error(cvt_centroids(kCells, 2, 0, 1, Seed(22)), rng);
  EXPECT_LT(error, 1.2 * hexagons);
  EXPECT_GT(error, 0.98 * hexagons);
}

// On a line the best cells are of equal length.
TEST(CvtCentroids, CutALineIntoEqualParts) {
  Rows centroids = cvt_centroids(4, 1, -1, 1, Seed(23));
  std::sort(centroids.data(), centroids.data() + 4);
  for (int c = 0; c < 4; ++c) EXPECT_NEAR(centroids(c, 0), -0.75f + 0.5f * c, 0.15);
}

TEST(CvtCentroids, AreAFunctionOfTheSeed) {
  for (const int d : {1, 2, 5, 8}) {
    const Rows one = cvt_centroids(50, d, 0, 1, Seed(24)), same = cvt_centroids(50, d, 0, 1, Seed(24));
    EXPECT_EQ(one, same);
    EXPECT_NE(one, cvt_centroids(50, d, 0, 1, Seed(25)));
    EXPECT_EQ(one.cols(), d);
    EXPECT_GT(one.minCoeff(), 0);
    EXPECT_LT(one.maxCoeff(), 1);
  }
}

TEST(CvtArchiveDeathTest, RefusesTooManyDimensions) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_DEATH(make_cvt_archive(3, Rows::Zero(5, 9), 0, 1), "descriptor size 9, expected 1 to 8");
}

}  // namespace
}  // namespace hbr
