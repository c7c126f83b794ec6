#include "models/robot/plane/drawing_servos.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

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
              testing::ThrowsMessage<InputError>(testing::HasSubstr("joint 'j9' draws, but this body")));
}

// The second joint is to turn by 2 rad in so many seconds, and can turn by 0.1 rad/s.
TEST(DrawingServos, AMovementBeyondALimitIsSlower) {
  RobotModel model = chain({Turn{}, Turn{}})->model();
  for (Joint& joint : model.joints) joint.effort = joint.velocity = 0;  // no limits
  model.joints[model.joint("j1")].velocity = 0.1;
  RobotSettings robot;
  robot.joints = {"j0", "j1"};
  const DrawingServos servos(std::make_shared<const Body>(model, robot.joints), robot);
  const auto turn = [&](double seconds, double longest) {
    return path_within_limits({0, 0, 0.5, 2}, {0, seconds}, 0.05, {&servos}, 0.01, longest);
  };
  const PacedPath slowed = turn(10, 1e3);
  EXPECT_NEAR(slowed.pace, 0.9 / 2, 1e-9);
  EXPECT_NEAR(slowed.path.duration(), 10 / 0.45, 0.2);
  EXPECT_NEAR(servos.fastest(slowed, 0.01).factor, 0.5, 1e-9);  // of the pace that was asked for
  for (const auto& [seconds, longest, faster] : {std::tuple(40., 1e3, 2.), {10., 20., 0.5}}) {
    const PacedPath asked = turn(seconds, longest);
    EXPECT_EQ(asked.pace, 1);
    EXPECT_EQ(asked.path.duration(), JointPath({0, 2}, {0, seconds}, 0.05).duration());
    EXPECT_NEAR(servos.fastest(asked, 0.01).factor, faster, 1e-9);
  }
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
  // One of those that draw is too light to count, and draws all the same.
  RobotModel light = body->model();
  light.links[light.link("link2")].inertial = Inertial{1e-4, {0, 0, 0}, 1e-7 * Eigen::Matrix3d::Identity()};
  robot.joints = {"j0", "j2"};
  robot.stands_on = "";
  const auto whole = whole_body(light, robot, 1e-3);
  ASSERT_TRUE(whole);
  EXPECT_THAT(whole->moving(), testing::ElementsAre("j0", "j1", "j2"));
  EXPECT_NO_THROW(DrawingServos(whole, robot));
}

}  // namespace
}  // namespace hbr
