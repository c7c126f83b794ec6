// Turns of strokes: of polygons that are known, and of digits against a plain second execution.
#include "stages/studies/stroke_turns.h"

#include <gmock/gmock.h>

#include "pipeline/core/check.h"
#include "pipeline/hierarchy/layers/digits.h"
#include "tests/stages/random_hierarchy.h"

namespace hbr {
namespace {

using Points = std::vector<Eigen::Vector2d>;
using testing::Each;
using testing::ElementsAre;
using testing::FloatNear;

// `corners` of a regular polygon of n sides, in the direction of `sense`.
Points polygon(int n, int corners, double sense) {
  Points points;
  for (int i = 0; i < corners; ++i) {
    const double angle = sense * 2 * std::numbers::pi * i / n;
    points.emplace_back(3 * std::cos(angle), 3 * std::sin(angle) - 1);
  }
  return points;
}

TEST(StrokeTurns, OfARegularPolygonAreEqual) {
  for (const double sense : {-1.0, 1.0}) {
    const StrokeTurns turns = stroke_turns(polygon(12, 13, sense), 5);
    ASSERT_EQ(turns.turn.size(), 11u);
    EXPECT_THAT(turns.turn, Each(FloatNear(static_cast<float>(sense * std::numbers::pi / 6), 1e-6f)));
    EXPECT_THAT(turns.joint, ElementsAre(0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0));
    EXPECT_NEAR(turns.length, 12 * 2 * 3 * std::sin(std::numbers::pi / 12), 1e-5);
    EXPECT_NEAR(turns.side, 6, 1e-6);
  }
  EXPECT_THAT(stroke_turns(polygon(12, 13, 1), 0).joint, Each(0));
}

// Standing still is no turn, neither at first nor between, and a joint is not lost by it.
TEST(StrokeTurns, PassOverSegmentsOfNoLength) {
  const Points points{{0, 0}, {0, 0}, {1, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 1}, {0, 0}};
  const StrokeTurns turns = stroke_turns(points, 5);
  EXPECT_THAT(turns.turn, Each(FloatNear(static_cast<float>(std::numbers::pi / 2), 1e-6f)));
  EXPECT_THAT(turns.joint, ElementsAre(0, 0, 1));
  EXPECT_EQ(turns.length, 4);
  EXPECT_EQ(turns.side, 1);
}

TEST(StrokeTurns, TurnRoundIsHalfATurn) {
  const StrokeTurns turns = stroke_turns(Points{{0, 0}, {2, 0}, {1, 0}}, 0);
  ASSERT_EQ(turns.turn.size(), 1u);
  EXPECT_NEAR(std::abs(turns.turn[0]), std::numbers::pi, 1e-6);
  EXPECT_TRUE(stroke_turns({}, 5).turn.empty());
  EXPECT_TRUE(stroke_turns(Points{{1, 1}, {1, 1}}, 5).turn.empty());
}

// Arc after arc, each from where the one before stopped.
TEST(StrokeTurns, StopsAreThoseOfThePlainExecution) {
  Hierarchy hierarchy(400, Seed(1));
  hierarchy.stack.add(make_digits({0.0128, "radius", 0.05, {"box", 1, 4}}, {kArm, &hierarchy.stack}),
                      random_elites(1, 12, 2, *std::make_unique<Rng>(Seed(2))));
  const Executor& executor = *hierarchy.stack.model(3).executor();
  Rng rng(Seed(3));
  for (int trial = 0; trial < 30; ++trial) {
    const int arcs = 1 + trial % 3;
    std::vector<float> genome(3 + 3 * static_cast<std::size_t>(arcs));
    for (float& gene : genome) gene = 0.3f + 0.4f * rng.uniform();  // within L
    const Eigen::Vector2d start = kFrame.point(Eigen::Vector2d(genome[0], genome[1]));
    Points expected{hierarchy.position(hierarchy.start_at(start))};
    for (int a = 0; a < arcs; ++a) {
      Rows command(1, 3);
      for (int k = 0; k < 3; ++k) command(0, k) = genome[3 + 3 * static_cast<std::size_t>(a) + k];
      const int from = hierarchy.start_at(expected.back());
      const Points more = hierarchy.arc(from, command);
      expected.insert(expected.end(), more.begin() + 1, more.end());
    }
    const Points found = stops_of(executor, genome.data(), static_cast<int>(genome.size()));
    ASSERT_EQ(found.size(), expected.size());
    ASSERT_EQ(found.size(), 5u * static_cast<std::size_t>(arcs) + 1);
    for (std::size_t k = 0; k < found.size(); ++k) EXPECT_LT((found[k] - expected[k]).norm(), 1e-9) << trial;
  }
}

}  // namespace
}  // namespace hbr
