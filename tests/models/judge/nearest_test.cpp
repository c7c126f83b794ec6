#include "models/judge/nearest.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "pipeline/core/random.h"

namespace hbr {
namespace {

Rows random_rows(Eigen::Index n, Eigen::Index d, std::uint64_t seed) {
  Rng rng{Seed(seed)};
  return Rows::NullaryExpr(n, d, [&] { return rng.uniform(); });
}

TEST(NearestRows, AreThoseOfBruteForceInDouble) {
  const Rows table = random_rows(2500, 7, 1), queries = random_rows(300, 7, 2);
  Workers workers(2);
  const auto nearest = nearest_rows(table, queries, 5, workers);
  for (Eigen::Index q = 0; q < queries.rows(); ++q) {
    std::vector<double> distance(table.rows());
    for (Eigen::Index t = 0; t < table.rows(); ++t)
      distance[t] = (queries.row(q) - table.row(t)).cast<double>().norm();
    std::vector<std::int32_t> order(table.rows());
    std::iota(order.begin(), order.end(), 0);
    std::partial_sort(order.begin(), order.begin() + 5, order.end(),
                      [&](int a, int b) { return distance[a] < distance[b]; });
    for (int i = 0; i < 5; ++i) EXPECT_NEAR(distance[nearest[q * 5 + i]], distance[order[i]], 1e-5) << q;
  }
}

TEST(NearestRows, OfEqualsTheFirst) {
  const Rows table = Rows::Ones(2000, 3);
  Workers workers(1);
  EXPECT_EQ(nearest_rows(table, Rows::Zero(1, 3), 3, workers), (std::vector<std::int32_t>{0, 1, 2}));
}

TEST(NearestRows, DoNotDependOnThreads) {
  const Rows table = random_rows(1500, 324, 3), queries = random_rows(700, 324, 4);
  Workers one(1), two(2);
  EXPECT_EQ(nearest_rows(table, queries, 3, one), nearest_rows(table, queries, 3, two));
}

}  // namespace
}  // namespace hbr
