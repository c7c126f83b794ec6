#include "pipeline/qd/places.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace hbr {
namespace {

Rows random_rows(int n, int d, Seed seed) {
  Rng rng(seed);
  Rows rows(n, d);
  for (float& x : rows.reshaped<Eigen::RowMajor>()) x = rng.uniform(0, 1);
  return rows;
}

TEST(Places, NearestElitesAreThoseOfAPlainLoop) {
  for (const int d : {1, 2, 5}) {
    Elites elites;
    elites.measures = random_rows(200, d, Seed(1));
    elites.measures.row(7) = elites.measures.row(90);  // as near as another
    const Rows places = random_rows(100, d, Seed(2));
    const NearestElites found = nearest_elites(places, elites);
    for (int i = 0; i < 100; ++i) {
      double least = std::numeric_limits<double>::infinity();
      for (int e = 0; e < 200; ++e) {
        double squared = 0;
        for (int k = 0; k < d; ++k)
          squared +=
              std::pow(static_cast<double>(places(i, k)) - static_cast<double>(elites.measures(e, k)), 2);
        least = std::min(least, std::sqrt(squared));
      }
      EXPECT_NEAR(found.distance[i], least, 1e-6);
      EXPECT_NEAR((places.row(i) - elites.measures.row(found.elite[i])).norm(), least, 1e-6);
    }
  }
  Elites twins;
  twins.measures = Rows::Constant(3, 2, 0.5f);
  EXPECT_THAT(nearest_elites(Rows::Constant(1, 2, 0.1f), twins).elite, testing::ElementsAre(0));
}

TEST(Places, BesideAreMovedByAsMuchInAllDirectionsAndStayInside) {
  const Rows places = Rows::Constant(5000, 2, 0.5f);
  const Rows moved = places_beside(places, 0.1, Seed(3));
  EXPECT_LE((moved - places).cwiseAbs().maxCoeff(), 0.1f + 1e-6f);
  EXPECT_NEAR((moved - places).mean(), 0, 0.002);
  EXPECT_NEAR((moved - places).cwiseAbs2().mean(), 0.1 * 0.1 / 3, 1e-4);  // a uniform distribution's variance
  EXPECT_EQ(places_beside(places, 0.1, Seed(3)), moved);
  EXPECT_EQ(places_beside(places, 0, Seed(3)), places);
  const Rows corner = places_beside(Rows::Zero(1000, 2), 0.1, Seed(4));
  EXPECT_GE(corner.minCoeff(), 0);
  EXPECT_NEAR((corner.array() == 0).cast<float>().mean(), 0.5, 0.05);
}

}  // namespace
}  // namespace hbr
