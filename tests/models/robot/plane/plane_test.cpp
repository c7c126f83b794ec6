#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "models/robot/plane/plane_file.h"
#include "models/robot/plane/refine_plane.h"
#include "models/robot/plane/robot_on_plane.h"
#include "pipeline/core/check.h"
#include "tests/models/robot/plane/three_links.h"

namespace hbr {
namespace {

const DrawingPlane kPlane = DrawingPlane::facing({.1, -.2, .3}, -.4, .2, .26);

TEST(DrawingPlane, IsUprightAsTheRobotSeesIt) {
  // A robot that looks along x with z up has y to its left.
  const DrawingPlane ahead = DrawingPlane::facing({1, 0, 0}, 0, 0, 2);
  EXPECT_LT((ahead.to_robot({1, 0}) - Eigen::Vector3d(1, -2, 0)).norm(), 1e-15);
  EXPECT_LT((ahead.to_robot({0, 1}) - Eigen::Vector3d(1, 0, 2)).norm(), 1e-15);
  EXPECT_LT((ahead.normal() - Eigen::Vector3d(-1, 0, 0)).norm(), 1e-15);
  // Whatever the direction: x stays level, y points up, the normal looks back at the robot.
  EXPECT_NEAR(kPlane.u[2], 0, 1e-15);
  EXPECT_GT(kPlane.v[2], 0.9);
  const Eigen::Vector3d looks(std::cos(.2) * std::cos(-.4), std::cos(.2) * std::sin(-.4), std::sin(.2));
  EXPECT_LT((kPlane.normal() + looks).norm(), 1e-15);
}

TEST(DrawingPlane, GoesToTheRobotAndBack) {
  Rng rng(Seed(1).child("plane"));
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector2d p(rng.uniform(-1, 1), rng.uniform(-1, 1));
    const double off = rng.uniform(-.01f, .01f);
    const Pen pen = kPlane.to_pen(kPlane.to_robot(p) + off * kPlane.normal());
    EXPECT_LT((pen.position - p).norm(), 1e-15);
    EXPECT_NEAR(pen.off_plane, off, 1e-15);
    // A similarity: lengths grow by the scale.
    EXPECT_NEAR((kPlane.to_robot(p) - kPlane.to_robot({0, 0})).norm(), .26 * p.norm(), 1e-15);
  }
}

TEST(DrawingPlane, SurvivesItsFile) {
  const TestFolder folder;
  const auto path = folder.path() / "plane.h5";
  Hdf5Writer file(path);
  EXPECT_EQ(write_plane(file, kPlane, {{0, 1}, {2, 3}}, {1e-4, 1e-2}, 1e-3), 0.5);
  file.close();
  const DrawingPlane back = load_plane(path);
  EXPECT_EQ(back.origin, kPlane.origin);
  EXPECT_EQ(back.u, kPlane.u);
  EXPECT_EQ(back.v, kPlane.v);
  EXPECT_EQ(back.scale, kPlane.scale);
  EXPECT_THAT(Hdf5Reader(path).read<std::uint8_t>("reached").values, testing::ElementsAre(1, 0));
}

TEST(DrawingPlane, RefusesAFileWithoutAPlane) {
  const TestFolder folder;
  const auto path = folder.path() / "plane.h5";
  DrawingPlane skew = kPlane;
  skew.v = (skew.v + .1 * skew.u).normalized();
  Hdf5Writer file(path);
  write_plane(file, skew, {}, {}, 1e-3);
  file.close();
  EXPECT_THROW(load_plane(path), InputError);
}

TEST(Reach, DistanceIsTheOneToTheDisc) {
  const auto body = two_links();
  const Clearance clearance(*body, body->model().link("tip"));
  const Reach reach(*body, body->model().link("tip"), clearance, 500, 0, Seed(2));
  Rng rng(Seed(3).child("reach"));
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d target(rng.uniform(-3, 3), rng.uniform(-3, 3), rng.uniform(-1, 1));
    const double beyond = std::max(0., std::hypot(target[0], target[1]) - 2);
    const Reach::Nearest nearest = reach.nearest(target, {DrawingPlane::facing(target, 0, 0, 1), 0}, 8, 1e-9);
    EXPECT_NEAR(nearest.gap.norm(), std::hypot(beyond, target[2]), 2e-4) << target.transpose();
    EXPECT_LT(
        (body->position(body->model().link("tip"), nearest.joints.data()) + nearest.gap - target).norm(),
        1e-12);
  }
}

TEST(RobotOnPlane, RefusesWhatDoesNotMoveTheTip) {
  const auto body = two_links();
  EXPECT_NO_THROW(RobotOnPlane("two", body, "tip", kPlane));
  EXPECT_THROW(RobotOnPlane("two", body, "upper", kPlane), InputError);
  EXPECT_THROW(RobotOnPlane("two", body, "hand", kPlane), InputError);
}

TEST(RobotOnPlane, RefusesAJointThatCanOnlyStand) {
  EXPECT_NO_THROW(
      RobotOnPlane("two", chain({Turn{}, Turn{.lower = -1, .upper = 1}}, "0 0 1"), "tip", kPlane));
  EXPECT_THAT(
      [] {
        RobotOnPlane("two", chain({Turn{}, Turn{.lower = .5, .upper = .5}}, "0 0 1"), "tip", kPlane);
      },
      testing::ThrowsMessage<InputError>(
          testing::HasSubstr("can only stand at 0.5: its <limit> is missing")));
}

TEST(MakeRobot, RefusesARestBeyondTheLimits) {
  const TestFolder folder;
  const std::string links = link("a") + link("b") + link("c");
  RobotSettings settings;
  settings.name = "mine";
  settings.urdf = folder.write("a.urdf", robot(links + joint("j", "a", "b") + joint("k", "b", "c"))).string();
  settings.tip_link = "c";
  settings.joints = {"k"};
  settings.rest_joints = {"j"};
  settings.rest_positions = {1};
  EXPECT_EQ(make_robot(settings, kPlane).dof(), 1);
  settings.rest_positions = {1.5};
  EXPECT_THAT([&] { make_robot(settings, kPlane); },
              testing::ThrowsMessage<InputError>(testing::HasSubstr(
                  "robot 'mine': rest_positions has joint 'j' at 1.5; expected -1 to 1, its limits in ")));
}

TEST(MakeRobot, RefusesARestOfWhatFollows) {
  const TestFolder folder;
  RobotSettings settings;
  settings.name = "mine";
  settings.urdf = folder
                      .write("a.urdf", robot(link("a") + link("b") + link("c") + joint("j", "a", "b") +
                                             joint("k", "b", "c", "revolute",
                                                   "<limit lower='-1' upper='1' effort='1' velocity='1'/>"
                                                   "<mimic joint='j'/>")))
                      .string();
  settings.tip_link = "c";
  settings.joints = {"j"};
  settings.rest_joints = {"k"};
  settings.rest_positions = {0.5};
  EXPECT_THAT([&] { make_robot(settings, kPlane); },
              testing::ThrowsMessage<InputError>(
                  testing::HasSubstr("robot 'mine': rest_joints has 'k', which mimics joint 'j' in ")));
}

TEST(MakeRobot, HasMetresForWhatSlides) {
  const TestFolder folder;
  std::string text = robot(link("a") + link("b") + link("c") + joint("j", "a", "b") + joint("k", "b", "c"));
  text.replace(text.find("revolute"), 8, "prismatic");
  RobotSettings settings;
  settings.name = "mine";
  settings.urdf = folder.write("a.urdf", text).string();
  settings.tip_link = "c";
  settings.joints = {"k", "j"};
  const RobotOnPlane made = make_robot(settings, kPlane);
  EXPECT_EQ(made.unit(0), "rad");
  EXPECT_EQ(made.unit(1), "m");
}

// A plane that is level with the two links can't be had (it stands upright), so what can be covered is a
// line.
TEST(RefinePlane, ComesNearerToTheReach) {
  const auto body = two_links();
  const DrawingPlane start = DrawingPlane::facing({.3, .2, .05}, .3, .4, 2.5);
  const Clearance clearance(*body, body->model().link("tip"));
  const Reach reach(*body, body->model().link("tip"), clearance, 500, .01, Seed(4));
  std::vector<Eigen::Vector2d> line;
  for (int i = -10; i <= 10; ++i) line.push_back({i / 10., 0});
  const auto worst = [&](const DrawingPlane& plane) {
    Workers one(1);
    const auto distances = distances_to_reach({plane, 0}, reach, line, one);
    return *std::max_element(distances.begin(), distances.end());
  };
  Workers one(1), two(2);
  const BoardRules rules(clearance, BoardKind::any);
  const DrawingPlane plane = refine_plane({start, 0}, rules, reach, line, one).plane;
  EXPECT_GT(worst(start), .5);
  EXPECT_LT(worst(plane), .05);
  const DrawingPlane again = refine_plane({start, 0}, rules, reach, line, two).plane;
  EXPECT_EQ(plane.origin, again.origin);
  EXPECT_EQ(plane.u, again.u);
  EXPECT_EQ(plane.scale, again.scale);
}

// The normal's z of a level board may be a rounding above 1, which is nobody's sine.
TEST(RefinePlane, KeepsALevelBoardLevel) {
  const DrawingPlane start =
      DrawingPlane::facing({.3, .2, .05}, -2.9634802056111047, -std::numbers::pi / 2, 1);
  ASSERT_GT(start.normal()[2], 1);
  const auto body = two_links();
  const Clearance clearance(*body, body->model().link("tip"));
  const Reach reach(*body, body->model().link("tip"), clearance, 500, .01, Seed(4));
  const std::vector<Eigen::Vector2d> points{{-.5, -.5}, {.5, -.5}, {-.5, .5}, {.5, .5}, {0, 0}};
  Workers one(1);
  const Board board = refine_plane({start, 0}, BoardRules(clearance, BoardKind::any), reach, points, one);
  EXPECT_TRUE(board.plane.origin.allFinite() && board.plane.u.allFinite() && board.plane.v.allFinite());
  EXPECT_EQ(board_kind(board.plane), BoardKind::level);
  const auto distances = distances_to_reach(board, reach, points, one);
  EXPECT_LT(*std::ranges::max_element(distances), .01);
}

// A circle of 2 m fits the reach of 3 m, but not where its board stands on the floor at the reach's middle:
// there it must become one of 1.5 m.
TEST(RefinePlane, ShrinksRatherThanGoBelowTheFloor) {
  const RobotOnPlane& robot = three_links();
  const Reach reach(robot.body(), robot.tip(), robot.clearance(), 500, 0, Seed(5));
  std::vector<Eigen::Vector2d> circle;
  for (int i = 0; i < 24; ++i)
    circle.emplace_back(std::cos(i / 24. * 2 * std::numbers::pi), std::sin(i / 24. * 2 * std::numbers::pi));
  Workers one(1);
  const BoardRules rules(robot.clearance(), BoardKind::any, 0);
  const Board board = refine_plane({DrawingPlane::facing({0, 0, 1}, 0, 0, 2), 1}, rules, reach, circle, one);
  EXPECT_GE(board.plane.origin.z() - board.plane.scale, -1e-6);
  EXPECT_NEAR(board.plane.scale, 1.5, 0.1);
  const auto distances = distances_to_reach(board, reach, circle, one);
  EXPECT_LT(*std::ranges::max_element(distances), 0.1);
}

}  // namespace
}  // namespace hbr
