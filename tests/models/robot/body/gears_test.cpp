// Friction and play in gears: closed forms, the balance of energy, and what must not move.
#include "models/robot/body/gears.h"

#include <gmock/gmock.h>

#include <cmath>

#include "models/robot/body/servos.h"
#include "tests/models/robot/body/rods.h"

namespace hbr {
namespace {

class GearsTest : public RodsTest {
 protected:
  static Gears rubbing(std::vector<double> viscous, std::vector<double> coulomb) {
    const auto n = static_cast<Eigen::Index>(viscous.size());
    return {Eigen::Map<Eigen::ArrayXd>(viscous.data(), n), Eigen::Map<Eigen::ArrayXd>(coulomb.data(), n), {}};
  }
  static Gears loose(double play) {
    return {Eigen::ArrayXd::Zero(1), Eigen::ArrayXd::Zero(1), Eigen::ArrayXd::Constant(1, play)};
  }
  static Eigen::VectorXd one(double value) { return Eigen::VectorXd::Constant(1, value); }
};

void coast(Motion& motion, const Gears& gears, double step) {
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(motion.joints().size());
  motion.step(friction_torques(gears, motion, none, step), step);
}

TEST_F(GearsTest, ASmallSwingDiesAwayByViscousFriction) {
  const Body body(pendulum(), {"a"});
  const double d = 0.4, k = kMass * kG * kArm, w = std::sqrt(k / kInertia), decay = d / (2 * kInertia),
               damped = std::sqrt(w * w - decay * decay), step = 1e-4;
  Motion motion(body, one(0.01), one(0));
  for (int i = 1; i <= 20000; ++i) {
    coast(motion, rubbing({d}, {0}), step);
    const double t = i * step;
    ASSERT_NEAR(motion.joints()[0],
                0.01 * std::exp(-decay * t) * (std::cos(damped * t) + decay / damped * std::sin(damped * t)),
                2e-5)
        << t;
  }
  EXPECT_LT(std::exp(-decay * 2), 0.2);  // it did die away
}

TEST_F(GearsTest, CoulombsFrictionStopsAJointForGood) {
  const Body body(pendulum(), {"a"});
  const double c = 0.3, speed = 2, step = 1e-4;
  Motion motion(body, one(0), one(speed), Eigen::Vector3d::Zero());
  double stopped = 0;
  for (int i = 1; i <= 20000; ++i) {
    coast(motion, rubbing({0}, {c}), step);
    if (motion.speeds()[0] == 0 && stopped == 0) stopped = i * step;
    if (stopped == 0) {
      ASSERT_NEAR(motion.speeds()[0], speed - c / kInertia * i * step, 1e-9);
    }
  }
  EXPECT_NEAR(stopped, kInertia * speed / c, 2 * step);
  EXPECT_NEAR(motion.joints()[0], kInertia * speed * speed / (2 * c), 1e-3);
  EXPECT_EQ(motion.speeds()[0], 0);
}

TEST_F(GearsTest, WhatSticksHoldsTheWeight) {
  const Body body(chain(), {"a", "b", "c"});
  const Eigen::Vector3d posture(0.5, -0.7, 0.3);
  Equations e;
  body.equations(posture, Eigen::Vector3d::Zero(), kGravity, e);
  Motion motion(body, posture, Eigen::Vector3d::Zero());
  for (int i = 0; i < 100; ++i) coast(motion, rubbing({0, 0, 0}, {40, 40, 40}), 0.01);
  EXPECT_EQ(motion.joints(), posture);
  // A little less than the weight of one of them: it alone gives way at first.
  const double less = 0.9 * std::abs(e.bias[0]);
  ASSERT_LT(std::abs(e.bias[1]), less);
  coast(motion, rubbing({0, 0, 0}, {less, 40, 40}), 1e-3);
  EXPECT_GT(std::abs(motion.speeds()[0]), 1e-4);
  EXPECT_NEAR(motion.speeds()[1], 0, 1e-15);
}

// What a chain loses is the work of friction; with half the step the error is half as large.
TEST_F(GearsTest, EnergyGoesIntoFriction) {
  const Body body(chain(), {"a", "b", "c"});
  const Eigen::Array3d viscous(0.3, 0.1, 0.2), coulomb(0.2, 0.5, 0.1);
  const auto missing = [&](double step) {
    Motion motion(body, Eigen::Vector3d(1.2, -0.5, 0.8), Eigen::Vector3d(0.3, 0, -1));
    const double before = motion.energy();
    double heat = 0;
    for (int i = 0; i < std::lround(1.5 / step); ++i) {
      coast(motion, {viscous, coulomb, {}}, step);
      const Eigen::Array3d v = motion.speeds();
      heat += step * (viscous * v * v + coulomb * v.abs()).sum();
    }
    EXPECT_GT(heat, 1);
    return before - motion.energy() - heat;
  };
  const double coarse = missing(1e-3), fine = missing(5e-4);
  EXPECT_LT(std::abs(fine), 0.1);
  EXPECT_NEAR(coarse / fine, 2, 0.2);
}

TEST_F(GearsTest, AnArmHangsInItsPlay) {
  const Body body(pendulum(), {"a"});
  for (const double at : {0.4, -0.4}) {
    const Replay held =
        replay(body, 2, JointPath({at}, {0}, 0.05), {0}, one(0), {0.002, 5, 5, 3}, {loose(0.02), nullptr});
    // The motor bears it from below: the joint is that much nearer to hanging down.
    const Eigen::VectorXd hangs = one(at - std::copysign(0.01, at));
    for (const Eigen::Vector3d& tip : held.tip)
      EXPECT_LT((tip - body.position(2, hangs.data())).norm(), 1e-6);
  }
}

// Where nothing loads it, a joint has gone round less than its motor by the play, either way.
TEST_F(GearsTest, PlayIsLostWhereTheMotorTurnsBack) {
  const Body body(pendulum(), {"a"});
  const double play = 0.05, w = 3, step = 1e-4;
  Gears gears = loose(play);
  gears.viscous[0] = 30;  // so that the joint does not run on by itself
  Motion motion(body, one(0), one(0), Eigen::Vector3d::Zero());
  Motors motors(gears, motion.joints(), one(1));
  double high = -1, low = 1, high_motor = -1, low_motor = 1;
  for (int i = 0; i < 60000; ++i) {
    const double wanted = 0.3 * std::sin(w * i * step);
    const Eigen::VectorXd acceleration =
        one(400 * (wanted - motors.positions()[0]) - 40 * motors.speeds()[0]);
    const Eigen::VectorXd torque = kInertia * acceleration + gears.viscous[0] * motors.speeds();
    Eigen::VectorXd driven = motors.handed_on(torque);
    driven += friction_torques(gears, motion, driven, step);
    motion.step(driven, step);
    motors.follow(motion, torque, acceleration, step);
    ASSERT_LE(std::abs(motors.positions()[0] - motion.joints()[0]), play / 2 + 1e-12);
    if (i < 30000) continue;
    high = std::max(high, motion.joints()[0]);
    low = std::min(low, motion.joints()[0]);
    high_motor = std::max(high_motor, motors.positions()[0]);
    low_motor = std::min(low_motor, motors.positions()[0]);
  }
  EXPECT_NEAR((high_motor - low_motor) - (high - low), play, 0.1 * play);
  EXPECT_GT(high - low, 0.3);
}

// In the middle of its play a joint is free: its energy stays while the servo does what it likes.
TEST_F(GearsTest, AJointInItsPlayIsFree) {
  const Body body(pendulum(), {"a"});
  Motion free(body, one(0.1), one(0)), held(body, one(0.1), one(0));
  Motors motors(loose(1), held.joints(), one(1));
  for (int i = 0; i < 100; ++i) {
    const Eigen::VectorXd torque = one(-3);  // away from the side that the motor touches
    free.step(one(0), 1e-3);
    held.step(motors.handed_on(torque), 1e-3);
    motors.follow(held, torque, one(-0.5), 1e-3);
  }
  EXPECT_EQ(free.joints(), held.joints());
  EXPECT_LT(motors.positions()[0], 0.6);
  EXPECT_GT(motors.positions()[0], held.joints()[0] - 0.5);
}

TEST_F(GearsTest, NoGearsChangeNothing) {
  const Body body(body_and_arm(), {"a", "b", "c"});
  const JointPath path({0, 0, 0.3, -0.2}, {0, 0.5}, 0.1);
  const Gears none{Eigen::ArrayXd::Zero(3), Eigen::ArrayXd::Zero(3), Eigen::ArrayXd::Zero(3)};
  const Replay without = replay(body, 4, path, {1, 2}, Eigen::Vector3d::Zero(), {0.002, 5, 5, 3}),
               with =
                   replay(body, 4, path, {1, 2}, Eigen::Vector3d::Zero(), {0.002, 5, 5, 3}, {none, nullptr});
  EXPECT_EQ(without.tip, with.tip);
  // Friction that the servos do not know of leaves them behind.
  const Replay rubbed = replay(body, 4, path, {1, 2}, Eigen::Vector3d::Zero(), {0.002, 5, 5, 3},
                               {{none.viscous, Eigen::Array3d(0, 0.05, 0.05), none.play}, nullptr});
  EXPECT_GT((rubbed.tip[20] - rubbed.wanted[20]).norm(), 2 * (with.tip[20] - with.wanted[20]).norm());
}

}  // namespace
}  // namespace hbr
