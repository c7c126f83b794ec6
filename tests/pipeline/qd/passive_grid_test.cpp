#include "pipeline/qd/passive_grid.h"

#include <gtest/gtest.h>

#include <map>

#include "pipeline/core/random.h"

namespace hbr {
namespace {

// Two repertoires, projected one after the other, against a map of the cells.
TEST(PassiveGrid, CountsTheFittestOfEveryCell) {
  PassiveGrid grid({2, 8, -1, 1});
  EXPECT_EQ(grid.filled(), 0u);
  EXPECT_EQ(grid.qd_score(-3), 0);
  Rng rng(Seed(34));
  std::map<std::pair<int, int>, double> best;
  for (const int n : {30, 50}) {
    Elites elites;
    elites.measures = Rows::NullaryExpr(n, 2, [&] { return rng.uniform(-1.2f, 1.2f); });
    elites.objective = Eigen::VectorXf::NullaryExpr(n, [&] { return rng.uniform(-3, 0); });
    grid.add(elites);
    for (int i = 0; i < n; ++i) {
      const auto cell = [&](int d) {  // an eighth of [-1, 1] is a quarter wide
        int c = 0;
        while (c < 7 && elites.measures(i, d) >= -1 + 0.25f * static_cast<float>(c + 1)) ++c;
        return c;
      };
      const auto fitness = static_cast<double>(elites.objective[i]);
      const auto [at, fresh] = best.try_emplace({cell(0), cell(1)}, fitness);
      at->second = std::max(at->second, fitness);
    }
    double sum = 0;
    for (const auto& [cell, fitness] : best) sum += fitness;
    const auto filled = static_cast<double>(best.size());
    EXPECT_EQ(grid.filled(), best.size());
    EXPECT_LT(filled, 64);
    EXPECT_NEAR(grid.qd_score(-3), sum + 3 * filled, 1e-9);
    EXPECT_NEAR(grid.mean(), sum / filled, 1e-12);
  }
}

}  // namespace
}  // namespace hbr
