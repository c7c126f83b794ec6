#include "models/robot/plane/board_rules.h"

#include <gtest/gtest.h>

#include <numbers>

#include "pipeline/core/check.h"
#include "tests/models/robot/body/chains.h"

namespace hbr {
namespace {

constexpr double kRad = std::numbers::pi / 180;

Board board(const Eigen::Vector3d& origin, double elevation_deg, double scale = 2, double half_side = .1) {
  return {DrawingPlane::facing(origin, .3, elevation_deg * kRad, scale), half_side};
}

TEST(BoardRules, KindsAreRangesOfTheNormalsAngle) {
  for (const double sign : {-1., 1.}) {
    EXPECT_EQ(board_kind(board({0, 0, 0}, sign * 19).plane), BoardKind::upright);
    EXPECT_EQ(board_kind(board({0, 0, 0}, sign * 21).plane), BoardKind::leaning);
    EXPECT_EQ(board_kind(board({0, 0, 0}, sign * 69).plane), BoardKind::leaning);
    EXPECT_EQ(board_kind(board({0, 0, 0}, sign * 71).plane), BoardKind::level);
    EXPECT_EQ(board_kind(board({0, 0, 0}, sign * 90).plane), BoardKind::level);
  }
  EXPECT_EQ(board_kind_named("leaning"), BoardKind::leaning);
  EXPECT_THROW(board_kind_named("tilted"), InputError);
}

// A box of 1 m about (0.5, 0, 0) that nothing moves.
const Body& beside_a_box() {
  static const TestFolder folder;
  static const std::string box =
      R"(<visual><origin xyz="0.5 0 0"/><geometry><box size="1 1 1"/></geometry></visual>)";
  static const Body body(
      load_urdf(folder.write("box.urdf", robot(link("a", box) + link("b") + joint("j", "a", "b")))), {"j"});
  return body;
}

TEST(BoardRules, ABoardIsWorthMoreBeforeTheRobotThanInIt) {
  const Clearance clearance(beside_a_box(), beside_a_box().model().link("b"));
  const BoardRules rules(clearance, BoardKind::any);
  const auto worth = [&](double x, double elevation) {
    return rules.worth({DrawingPlane::facing({x, 0, 0}, 0, elevation * kRad, 2), .1});
  };
  EXPECT_DOUBLE_EQ(worth(1.1, 0), 2);
  EXPECT_DOUBLE_EQ(worth(.9, 0), 1);
  EXPECT_DOUBLE_EQ(worth(-.1, 0), 1);  // behind the board
  EXPECT_DOUBLE_EQ(worth(3, -90), 2 * .95);
  EXPECT_DOUBLE_EQ(worth(3, -45), 2 * .9);
}

TEST(BoardRules, NothingOfTheSquareIsBelowTheFloor) {
  const Clearance clearance(beside_a_box(), beside_a_box().model().link("b"));
  const BoardRules rules(clearance, BoardKind::any, 1);
  for (const double elevation : {0., 30., -30., 80., -90.}) {
    // Of its four corners, the lowest.
    const Board low = board({3, 0, 1}, elevation);
    double lowest = 10;
    for (const double x : {-.1, .1})
      for (const double y : {-.1, .1}) lowest = std::min(lowest, low.plane.to_robot({x, y})[2]);
    EXPECT_EQ(rules.allows(low), elevation <= 0 && lowest >= 1 - 1e-9) << elevation;
    const Board raised = rules.raised(low);
    EXPECT_EQ(rules.allows(raised), elevation <= 0) << elevation;
    Board sunk = raised;
    sunk.plane.origin[2] -= 1e-3;
    EXPECT_EQ(rules.allows(sunk), elevation <= 0 && lowest > 1 + 1e-3) << elevation;
    EXPECT_NEAR(raised.plane.origin[2] - low.plane.origin[2], 1 - lowest, 1e-12) << elevation;
    EXPECT_EQ(rules.raised(board({3, 0, 2}, elevation)).plane.origin[2], 2) << elevation;
  }
}

TEST(BoardRules, OneKindIsAllowedWhereItIsAskedAndNoneThatHangsOver) {
  const Clearance clearance(beside_a_box(), beside_a_box().model().link("b"));
  for (const BoardKind kind : {BoardKind::level, BoardKind::upright, BoardKind::leaning}) {
    const BoardRules rules(clearance, kind);
    for (int elevation = -89; elevation <= 89; ++elevation) {
      const Board candidate = board({3, 0, 0}, elevation);
      EXPECT_EQ(rules.allows(candidate), elevation <= 0 && board_kind(candidate.plane) == kind) << elevation;
    }
  }
}

TEST(BoardRules, ARangeOfElevationsIsOfOneKind) {
  for (int elevation = -89; elevation <= 89; elevation += 2) {
    const auto [from, to] = elevations_about(elevation * kRad);
    EXPECT_LE(from, elevation * kRad);
    EXPECT_GE(to, elevation * kRad);
    for (const double share : {.001, .5, .999})
      EXPECT_EQ(board_kind(board({0, 0, 0}, (from + share * (to - from)) / kRad).plane),
                board_kind(board({0, 0, 0}, elevation).plane))
          << elevation;
  }
}

// Shapes that lean by 30 degrees about y, on a link that stands 1 m up and turns by nothing.
TEST(FloorUnder, IsTheLowestPointOfWhatStandsStill) {
  const TestFolder folder;
  const auto floor = [&](const std::string& geometry, const std::string& moved = "") {
    const std::string looks = "<visual><origin xyz=\"0 0 1\" rpy=\"0 0.5235987755982988 0\"/><geometry>" +
                              geometry + "</geometry></visual>";
    return floor_under(
        Body(load_urdf(folder.write("floor.urdf", robot(link("a", geometry.empty() ? "" : looks) +
                                                        link("b", moved) + joint("j", "a", "b")))),
             {"j"}));
  };
  const double c = std::cos(30 * kRad), s = std::sin(30 * kRad);
  EXPECT_NEAR(floor(R"(<box size="0.4 0.3 0.2"/>)"), 1 - (.4 * s + .2 * c) / 2, 1e-12);
  EXPECT_NEAR(floor(R"(<cylinder radius="0.1" length="0.6"/>)"), 1 - (.3 * c + .1 * s), 1e-12);
  EXPECT_NEAR(floor(R"(<sphere radius="0.25"/>)"), .75, 1e-12);
  // What moves does not count; without any shape it is the root's origin.
  const std::string deep =
      R"(<visual><origin xyz="0 0 -9"/><geometry><sphere radius="1"/></geometry></visual>)";
  EXPECT_NEAR(floor(R"(<sphere radius="0.25"/>)", deep), .75, 1e-12);
  EXPECT_EQ(floor("", deep), 0);
}

}  // namespace
}  // namespace hbr
