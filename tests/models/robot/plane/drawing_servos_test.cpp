#include "models/robot/plane/drawing_servos.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/core/check.h"
#include "tests/models/robot/body/chains.h"

namespace hbr {
namespace {

// A plane that faces the robot along x, the arm's metre being half a metre there.
const DrawingPlane kHalfPlane = DrawingPlane::facing({1, 0, 0}, 0, 0, 0.5);

TEST(DrawingServos, ErrorsOfAKnownWay) {
  const auto on_plane = [](double x, double y) { return kHalfPlane.to_robot({x, y}); };
  const Eigen::Vector3d off = (kHalfPlane.to_robot({0, 1}) - kHalfPlane.to_robot({0, 0}))
                                  .cross(kHalfPlane.to_robot({1, 0}) - kHalfPlane.to_robot({0, 0}))
                                  .normalized();
  Replay replay;
  replay.wanted = {on_plane(0, 0), on_plane(0.1, 0), on_plane(0.2, 0), on_plane(0.3, 0)};
  replay.tip = {on_plane(0, 0), on_plane(0.1, 0.06), on_plane(0.2, 0) + 0.04 * off, on_plane(0.3, 0)};
  const ReplayErrors errors = replay_errors(replay, kHalfPlane);
  EXPECT_NEAR(errors.worst, 0.04, 1e-12);
  EXPECT_NEAR(errors.off_plane, 0.04, 1e-12);
  EXPECT_NEAR(errors.rms, std::sqrt((0.03 * 0.03 + 0.04 * 0.04) / 4), 1e-12);
  EXPECT_THAT(pen_of(replay.tip, kHalfPlane),
              testing::Pointwise(testing::FloatNear(1e-6f), {0.f, 0.f, 0.1f, 0.06f, 0.2f, 0.f, 0.3f, 0.f}));
}

// The joints that draw are found by their names, whatever their order in the body; the others hold their
// rest.
TEST(DrawingServos, DrawByTheJointsOfTheTable) {
  const auto body = chain({Turn{}, Turn{}, Turn{}});
  RobotSettings robot;
  robot.name = "chain";
  robot.joints = {"j2", "j0"};
  robot.rest_joints = {"j1"};
  robot.rest_positions = {0.4};
  const JointPath path({0.1, -0.3}, {0}, 0.05);  // of j2 and j0
  const ServoSettings servos{0.002, 5, 5, 3};
  const int tip = body->model().link("tip");
  const Replay by_table = DrawingServos(body, robot).replay(tip, path, servos),
               by_hand = replay(*body, tip, path, {2, 0}, Eigen::Vector3d(-0.3, 0.4, 0.1), servos);
  EXPECT_EQ(by_table.tip, by_hand.tip);
  EXPECT_EQ(by_table.wanted, by_hand.wanted);
  Eigen::Vector3d posture(-0.3, 0.4, 0.1);
  EXPECT_LT((by_table.wanted[0] - body->position(tip, posture.data())).norm(), 1e-12);
  robot.joints = {"j2", "j9"};
  EXPECT_THAT([&] { DrawingServos(body, robot); },
              testing::ThrowsMessage<InputError>(testing::HasSubstr("joint 'j9' moves less than")));
}

TEST(DrawingServos, GearsAreOfTheJointsThatDraw) {
  const auto body = chain({Turn{}, Turn{}, Turn{}});
  RobotSettings robot;
  robot.name = "chain";
  robot.joints = {"j2", "j0"};
  const JointPath path({0.1, -0.3, 0.4, 0.2}, {0, 1}, 0.05);
  const ServoSettings servos{0.002, 5, 5, 3};
  const int tip = body->model().link("tip");
  const GearSettings gear{"j0", 0.3, 0.2, 0.01};
  const Gears of_first{Eigen::Array3d(0.3, 0, 0), Eigen::Array3d(0.2, 0, 0), Eigen::Array3d(0.01, 0, 0)};
  const Replay by_table = DrawingServos(body, robot, {gear}).replay(tip, path, servos),
               by_hand =
                   replay(*body, tip, path, {2, 0}, Eigen::Vector3d::Zero(), servos, {of_first, nullptr});
  EXPECT_EQ(by_table.tip, by_hand.tip);
  EXPECT_NE(by_table.tip, DrawingServos(body, robot).replay(tip, path, servos).tip);
  for (const std::vector<GearSettings>& wrong : {std::vector{GearSettings{"j1", 0, 0, 0}}, {gear, gear}})
    EXPECT_THAT(
        [&] { DrawingServos(body, robot, wrong); },
        testing::ThrowsMessage<InputError>(testing::HasSubstr("joints that draw at most once: j2, j0")));
}

TEST(DrawingServos, AWholeBodyHasMoreThanWhatDraws) {
  const auto body = chain({Turn{}, Turn{}, Turn{}});
  RobotSettings robot;
  robot.joints = {"j0", "j1"};
  ASSERT_TRUE(whole_body(body->model(), robot, 1e-6));
  EXPECT_EQ(whole_body(body->model(), robot, 1e-6)->moving(), body->moving());
  robot.joints = {"j0", "j1", "j2"};
  EXPECT_FALSE(whole_body(body->model(), robot, 1e-6));
  robot.stands_on = "link0";
  EXPECT_TRUE(whole_body(body->model(), robot, 1e-6));
}

}  // namespace
}  // namespace hbr
