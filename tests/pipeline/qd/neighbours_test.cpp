// The neighbour structures against brute force.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "pipeline/core/random.h"
#include "pipeline/qd/nearest_table.h"
#include "pipeline/qd/neighbour_grid.h"

namespace hbr {
namespace {

// Points in clumps, some outside [0, 1], some equal.
template <int D>
Rows random_points(int n, Rng& rng) {
  Rows points(n, D);
  for (int i = 0; i < n; ++i)
    for (int d = 0; d < D; ++d)
      points(i, d) = i % 7 == 3 ? points(i - 1, d) : rng.uniform(i % 5 ? 0.2f : -0.2f, i % 3 ? 0.6f : 1.2f);
  return points;
}

template <int D>
void grid_agrees_with_brute_force() {
  Rng rng(Seed(1).child(D));
  const Rows points = random_points<D>(600, rng);
  NeighbourGrid<D> grid(0, 1, 0.07f);
  const auto point_of = [&](Slot s) { return points.row(s).data(); };
  for (Slot s = 0; s < 600; ++s) grid.insert(s, point_of(s));
  for (Slot s = 0; s < 600; s += 4) grid.erase(s);
  std::vector<Slot> present;
  for (Slot s = 0; s < 600; ++s)
    if (s % 4) present.push_back(s);

  for (int q = 0; q < 300; ++q) {
    float query[D];
    for (float& x : query) x = rng.uniform(-0.3f, 1.3f);
    const Slot excluded = q % 2 ? kNoSlot : present[q];
    std::vector<std::pair<float, Slot>> all;
    for (const Slot s : present)
      if (s != excluded) all.emplace_back(NeighbourGrid<D>::distance2(point_of(s), query), s);
    std::sort(all.begin(), all.end());

    typename NeighbourGrid<D>::Near near[15];
    ASSERT_EQ(grid.nearest(query, 15, excluded, near), 15);
    for (int k = 0; k < 15; ++k) {
      EXPECT_EQ(near[k].squared, all[k].first);
      EXPECT_EQ(near[k].slot, all[k].second);
    }
    for (const float radius : {0.03f, 0.07f, 0.1f, 0.4f}) {
      std::vector<Slot> within, expected;
      grid.near(query, radius, [&](Slot s, float squared) {
        EXPECT_EQ(squared, NeighbourGrid<D>::distance2(point_of(s), query));
        within.push_back(s);
        return true;
      });
      for (const Slot s : present)
        if (NeighbourGrid<D>::distance2(point_of(s), query) <= radius * radius) expected.push_back(s);
      std::sort(within.begin(), within.end());
      EXPECT_EQ(within, expected);
    }
  }
}

TEST(NeighbourGrid, AgreesWithBruteForceInAnyDimension) {
  grid_agrees_with_brute_force<1>();
  grid_agrees_with_brute_force<2>();
  grid_agrees_with_brute_force<3>();
  grid_agrees_with_brute_force<4>();
  grid_agrees_with_brute_force<6>();
}

// Cells as small as a tiny spacing asks for would fill the memory: they are larger then, and answers the
// same.
TEST(NeighbourGrid, HasNoMoreCellsThanFit) {
  Rng rng(Seed(2));
  const Rows points = random_points<4>(300, rng);
  NeighbourGrid<4> grid(0, 1, 1e-4f);
  for (Slot s = 0; s < 300; ++s) grid.insert(s, points.row(s).data());
  for (Slot q = 0; q < 300; ++q) {
    NeighbourGrid<4>::Near near[1];
    ASSERT_EQ(grid.nearest(points.row(q).data(), 1, q, near), 1);
    float least = std::numeric_limits<float>::infinity();
    for (Slot s = 0; s < 300; ++s)
      if (s != q)
        least = std::min(least, NeighbourGrid<4>::distance2(points.row(s).data(), points.row(q).data()));
    EXPECT_EQ(near[0].squared, least);
  }
}

TEST(NeighbourGrid, FewerThanAskedFor) {
  NeighbourGrid<2> grid(0, 1, 0.1f);
  const float p[2] = {0.5f, 0.5f};
  grid.insert(0, p);
  NeighbourGrid<2>::Near near[3];
  EXPECT_EQ(grid.nearest(p, 3, kNoSlot, near), 1);
  EXPECT_EQ(grid.nearest(p, 3, 0, near), 0);
}

template <int D>
void table_agrees_with_brute_force(int n, int asked = 20000) {
  Rng rng(Seed(2).child(D).child(n));
  const Rows points = random_points<D>(n, rng);
  const NearestTable<D> table(points, -0.1f, 1.1f);
  std::array<std::vector<float>, D> queries;
  std::vector<std::int32_t> all_expected;
  for (int q = 0; q < asked; ++q) {
    float query[D];
    for (int d = 0; d < D; ++d)
      query[d] =
          q % 10 == 0 ? points(rng.below(n), d) : rng.uniform(q % 4 ? 0.1f : -0.5f, q % 4 ? 0.7f : 1.5f);
    int expected = 0;
    for (int i = 1; i < n; ++i)
      if (NeighbourGrid<D>::distance2(points.row(i).data(), query) <
          NeighbourGrid<D>::distance2(points.row(expected).data(), query))
        expected = i;
    ASSERT_EQ(table.nearest(query), expected);
    all_expected.push_back(expected);
    for (int d = 0; d < D; ++d) queries[d].push_back(query[d]);
  }
  std::array<const float*, D> coordinates;
  for (int d = 0; d < D; ++d) coordinates[d] = queries[d].data();
  for (const int count : {0, 1, 63, 64, 65, asked}) {
    std::vector<std::int32_t> found(count);
    table.nearest(count, coordinates, found.data());
    EXPECT_TRUE(std::equal(found.begin(), found.end(), all_expected.begin()));
  }
}

TEST(NearestTable, AgreesWithBruteForce) {
  table_agrees_with_brute_force<1>(200);
  table_agrees_with_brute_force<2>(1);
  table_agrees_with_brute_force<2>(2);
  table_agrees_with_brute_force<2>(500);
  table_agrees_with_brute_force<3>(300);
  table_agrees_with_brute_force<2>(70000, 300);  // indices of more than 16 bits
}

}  // namespace
}  // namespace hbr
