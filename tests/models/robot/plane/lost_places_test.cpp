// On chains in their plane: why a place is not come to has closed forms.
#include "models/robot/plane/lost_places.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/robot/plane/points_on_plane.h"
#include "pipeline/hierarchy/joints.h"
#include "tests/models/robot/plane/three_links.h"

namespace hbr {
namespace {

// The layer of one elite, and the counts for these places.
Lacks counted(const RobotOnPlane& robot, const Eigen::VectorXd& joints,
              const std::vector<Eigen::Vector2d>& places) {
  Elites elites;
  elites.solution.resize(1, robot.dof());
  elites.measures = Rows::Zero(1, 2);
  elites.objective = Eigen::VectorXf::Zero(1);
  elites.solution.row(0) = encode_joints(robot, joints).transpose();
  elites.id.push_back(0);
  elites.parent.push_back(-1);
  perform_point(robot, kFrame, elites, 0);
  const PointLayer points(elites, robot, kFrame);
  const Reach reach(robot.body(), robot.tip(), robot.clearance(), 500, 0, Seed(1));
  return lacks_along(robot, points, reach, places, 0.1);
}

TEST(LostPlaces, GapsAreWithinReachAndLimitsBeyond) {
  Pen pen;
  const Eigen::Vector3d joints(0.3, 0.5, 0.4);
  three_links().pens(1, joints.data(), &pen);
  const Eigen::Vector2d there = pen.position, beside = there + Eigen::Vector2d(0.05, 0);
  EXPECT_THAT(counted(three_links(), joints, {there, beside, -there, {0.5, -1}, {2.5, 2.5}}),
              testing::ElementsAre(2, 2, 0, 1));
}

// Links of 1 m, 0.3 m thick: the last can come back to the base only through the first.
TEST(LostPlaces, WhatOnlyACollisionKeepsAwayIsNoLimit) {
  const std::string looks =
      R"(<visual><origin xyz="0 0.5 0"/><geometry><box size="0.3 1 0.3"/></geometry></visual>)";
  const auto body = chain({Turn{}, Turn{}, Turn{}}, "1 0 0", looks, 0.5);
  const RobotOnPlane robot("thick", body, "tip", DrawingPlane::facing({0.5, 0, 0}, 0, 0, 1), kTolerance);
  const Lacks lacks = counted(robot, Eigen::Vector3d(0.3, 0.5, 0.4), {{1, -1.5}, {0, 0.02}, {0, 3.2}});
  EXPECT_EQ(lacks[static_cast<std::size_t>(Lack::gap)], 1);
  EXPECT_EQ(lacks[static_cast<std::size_t>(Lack::limit)], 1);
  EXPECT_EQ(lacks[static_cast<std::size_t>(Lack::collision)], 1);
}

}  // namespace
}  // namespace hbr
