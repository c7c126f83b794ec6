// Servos: convergence, limits, and what must not move.
#include "models/robot/body/servos.h"

#include <gmock/gmock.h>

#include <cmath>

#include "pipeline/core/random.h"
#include "tests/models/robot/body/rods.h"

namespace hbr {
namespace {

class Servos : public RodsTest {};

const ServoSettings kServos{0.002, 5, 5, 3};

TEST_F(Servos, AServoAtRestStaysAtRest) {
  const Body body(chain(), {"a", "b", "c"});
  const Eigen::Vector3d posture(0.1, -0.1, 0.2);
  const JointPath path({-0.1, 0.2}, {0}, 0.05);  // of b and c; a holds
  const Replay still = replay(body, body.model().link("three"), path, {1, 2}, posture, kServos);
  for (const Eigen::Vector3d& tip : still.tip) EXPECT_LT((tip - still.wanted[0]).norm(), 1e-12);
  EXPECT_LT(still.speed.maxCoeff(), 1e-10);
  Equations e;
  body.equations(posture, Eigen::Vector3d::Zero(), kGravity, e);
  EXPECT_LT((still.torque - e.bias.cwiseAbs() / 9).norm(), 1e-10);
}

// A path of `seconds` through random postures within `range`.
JointPath wander(Eigen::Index dof, float range, double seconds, double smoothing, Seed seed) {
  Rng rng(seed);
  std::vector<double> joints, times;
  for (int i = 0; i < 6; ++i) {
    times.push_back(seconds / 5 * i);
    for (Eigen::Index k = 0; k < dof; ++k) joints.push_back(rng.uniform(-range, range));
  }
  return {joints, times, smoothing};
}

TEST_F(Servos, ReplayConvergesWithTheStep) {
  const Body body(body_and_arm(), {"a", "b", "c"});
  const JointPath path = wander(2, 0.3f, 2, 0.1, Seed(2));
  // Commands 8 ms apart, steps of 8, 4, 2 and 0.25 ms.
  const auto tip = [&](int steps) {
    const Replay run = replay(body, 4, path, {1, 2}, Eigen::Vector3d::Zero(), {8e-3 / steps, steps, 5, 3});
    EXPECT_LT(run.torque.maxCoeff(), 1);
    double worst = 0;
    for (std::size_t i = 0; i < run.tip.size(); ++i)
      worst = std::max(worst, (run.tip[i] - run.wanted[i]).norm());
    EXPECT_LT(worst, 0.01);
    EXPECT_GT(worst, 1e-4);  // the body gives way
    return run.tip[run.tip.size() / 2];
  };
  const Eigen::Vector3d exact = tip(32);
  const double coarse = (tip(1) - exact).norm(), middle = (tip(2) - exact).norm(),
               fine = (tip(4) - exact).norm();
  EXPECT_LT(fine, 1e-3);
  EXPECT_NEAR(coarse / middle, 2, 0.5);
  EXPECT_NEAR(middle / fine, 2, 0.5);
}

TEST_F(Servos, OneJointFollowsItsPath) {
  const Body body(pendulum(), {"a"});
  const JointPath path = wander(1, 0.3f, 2, 0.1, Seed(3));
  const Replay run = replay(body, 2, path, {0}, Eigen::VectorXd::Zero(1), kServos);
  for (std::size_t i = 0; i < run.tip.size(); ++i) EXPECT_LT((run.tip[i] - run.wanted[i]).norm(), 2e-3);
  EXPECT_LT((run.tip.front() - run.wanted.front()).norm(), 1e-15);
}

// The fastest pace, by moving at it: then the greatest share of a limit is 1.
TEST_F(Servos, FastestPaceReachesALimit) {
  const Body body(body_and_arm(), {"a", "b", "c"});
  int torque = 0, speed = 0;
  for (std::uint64_t trial = 0; trial < 12; ++trial) {
    const double seconds = trial % 2 ? 8 : 1;
    const float range = trial % 2 ? 1.f : 0.1f;
    const Eigen::VectorXd posture = Eigen::Vector3d(0.02, 0, 0);
    const auto path = [&](double factor) {
      return wander(2, range, seconds / factor, 0.1 / factor, Seed(4).child(trial));
    };
    const Fastest found = fastest(body, path(1), {1, 2}, posture, 0.01);
    if (found.factor == 0) continue;
    const JointPath faster = path(found.factor);
    Eigen::Vector3d torques = Eigen::Vector3d::Zero(), speeds = torques;
    for (int i = 0; i <= std::ceil(path(1).duration() / 0.01); ++i) {
      const JointPath::Point at = faster.at(i * 0.01 / found.factor);
      const Eigen::Vector3d q(posture[0], at.position[0], at.position[1]),
          v(0, at.velocity[0], at.velocity[1]), a(0, at.acceleration[0], at.acceleration[1]);
      Equations e;
      body.equations(q, v, kGravity, e);
      torques = torques.cwiseMax((e.mass * a + e.bias).cwiseAbs() / 9);
      speeds = speeds.cwiseMax(v.cwiseAbs() / 4);
    }
    EXPECT_NEAR((found.by_torque ? torques : speeds)[found.joint], 1, 1e-9) << trial;
    EXPECT_LT(std::max(torques.maxCoeff(), speeds.maxCoeff()), 1 + 1e-9) << trial;
    (found.by_torque ? torque : speed) += 1;
  }
  EXPECT_GT(torque, 0);
  EXPECT_GT(speed, 0);
}

TEST_F(Servos, StandingStillMayBeTooMuch) {
  const Body body(chain(), {"a", "b", "c"});
  const JointPath path({1.0, 0.0}, {0}, 0.05);
  const Fastest found = fastest(body, path, {1, 2}, Eigen::Vector3d(0.5, 0, 0), 0.01);
  EXPECT_EQ(found.factor, 0);
  EXPECT_TRUE(found.by_torque);
}

TEST_F(Servos, LimitsCutTorquesOff) {
  // Held straight out the rod needs 5.9 N m; its servo gives 3: it falls, and goes on falling no faster than
  // it may.
  std::string text = swinging("a", "base", "rod", "0 0 0");
  text.replace(text.find("effort=\"9\""), 10, "effort=\"3\"");
  const Body body(load(link("base") + link("rod", kRod) + text), {"a"});
  const JointPath path({1.5}, {0}, 0.05);
  const Replay run = replay(body, 1, path, {0}, Eigen::VectorXd::Zero(1), kServos);
  EXPECT_GT(run.torque[0], 5.8 / 3);
  EXPECT_GT(run.speed[0], 0.1);
}

TEST_F(Servos, NoServoDrivesAJointBeyondItsSpeed) {
  // Asked for 10 rad/s, with 4 allowed: the servo stops pushing there.
  const Body body(pendulum(), {"a"});
  const Replay run =
      replay(body, 2, JointPath({0, 2}, {0, 0.2}, 0.05), {0}, Eigen::VectorXd::Zero(1), kServos);
  EXPECT_GT(run.speed[0], 0.95);
  EXPECT_LT(run.speed[0], 1.05);
}

TEST_F(Servos, LightJointsAreFound) {
  const std::string feather =
      R"(<inertial><mass value="1e-6"/><inertia ixx="1e-9" iyy="1e-9" izz="1e-9" ixy="0" ixz="0" iyz="0"/></inertial>)";
  const RobotModel model =
      load(link("base") + link("rod", kRod) + link("finger", feather) + link("ghost", "") +
           swinging("a", "base", "rod", "0 0 0") + swinging("b", "rod", "finger", "0 0 -0.6") +
           swinging("c", "finger", "ghost", "0 0 -0.1"));
  EXPECT_EQ(joints_with_inertia(model, {}, 1e-6), (std::vector<std::string>{"a"}));
  EXPECT_EQ(joints_with_inertia(model, {}, 1e-10), (std::vector<std::string>{"a", "b"}));
}

}  // namespace
}  // namespace hbr
