// NAO's drawing plane: it is found, it covers the arm's area, and a start that does not is mended.
#include <gtest/gtest.h>

#include <numbers>

#include "models/robot/plane/find_plane.h"
#include "models/robot/plane/refine_plane.h"
#include "models/robot/plane/robot_on_plane.h"
#include "tests/models/nao/right_arm.h"

namespace hbr {
namespace {

// What the planar arm reaches of its disc: for x < 0 only within 7/8 of its length of (0, +-1/8 of it).
std::vector<Eigen::Vector2d> arm_area(double spacing) {
  const double r = .5815;
  std::vector<Eigen::Vector2d> points;
  for (double x = -r; x <= r; x += spacing)
    for (double y = -r; y <= r; y += spacing)
      if (std::hypot(x, y) <= r && (x >= 0 || std::hypot(x, std::abs(y) - r / 8) <= 7 * r / 8))
        points.push_back({x, y});
  return points;
}

constexpr double kHalfSide = .63965;  // m of the arm

double covered(const DrawingPlane& plane, const std::vector<Eigen::Vector2d>& points) {
  const RobotOnPlane robot = make_robot(nao_right_arm(), plane);
  const Clearance clearance(robot.body(), robot.tip());
  const Reach reach(robot.body(), robot.tip(), clearance, 20000, 0, Seed(1));
  Workers workers(2);
  double count = 0;
  for (const double distance : distances_to_reach({plane, kHalfSide}, reach, points, workers))
    count += distance < 1e-3;
  return count / double(points.size());
}

TEST(NaoPlane, RefinementCoversTheArmsArea) {
  const double rad = std::numbers::pi / 180;
  const auto fit = arm_area(.1), all = arm_area(.06);
  Workers workers(2);
  const auto refined = [&](const DrawingPlane& start) {
    const RobotOnPlane robot = make_robot(nao_right_arm(), start);
    const Clearance clearance(robot.body(), robot.tip());
    const Reach reach(robot.body(), robot.tip(), clearance, 20000, .05, Seed(2));
    return refine_plane({start, kHalfSide}, BoardRules(clearance, BoardKind::any), reach, fit, workers).plane;
  };
  const DrawingPlane good = DrawingPlane::facing({.143, -.152, .090}, -21.9 * rad, -4 * rad, .258);
  EXPECT_EQ(covered(refined(good), all), 1);
  const DrawingPlane bad = DrawingPlane::facing({.122, -.204, .090}, -39 * rad, -4 * rad, .258);
  EXPECT_LT(covered(bad, all), .9);
  EXPECT_GT(covered(refined(bad), all), .98);
}

// The best plane known before there was a search: radius 0.150 m, scale 0.258.
TEST(NaoPlane, SearchFindsOneAsGoodAsTheKnown) {
  const auto fit = arm_area(.06), all = arm_area(.05);
  Workers workers(2);
  const RobotOnPlane robot = make_robot(nao_right_arm(), DrawingPlane::facing({0, 0, 0}, 0, 0, 1));
  const Clearance clearance(robot.body(), robot.tip());
  const ReachMap map(robot.body(), robot.tip(), clearance, 200000, .05, Seed(3), workers);
  const Reach reach(robot.body(), robot.tip(), clearance, 20000, .05, Seed(2));
  PlaneSearchSettings settings;
  settings.refined = 1;
  const FoundPlane found =
      find_plane(robot.body(), BoardRules(clearance, BoardKind::any, floor_under(robot.body())), map, reach,
                 fit, kHalfSide, 1.5e-4, settings, workers);
  EXPECT_GE(found.covered, .99);
  EXPECT_GT(covered(found.board.plane, all), .99);
  EXPECT_GT(found.board.plane.scale, .258);
  EXPECT_LT(found.board.plane.scale, .29);  // NAO reaches a little farther than the disc of 0.155 m
}

}  // namespace
}  // namespace hbr
