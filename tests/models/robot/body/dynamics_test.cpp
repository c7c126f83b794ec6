// The equations of motion: closed forms, conservation, and what must not move.
#include "models/robot/body/motion.h"

#include <gmock/gmock.h>

#include <cmath>

#include "pipeline/core/random.h"
#include "tests/models/robot/body/rods.h"

namespace hbr {
namespace {

class Dynamics : public RodsTest {};

double torque_of(const Body& body, double q, double speed, double acceleration) {
  Equations e;
  body.equations(Eigen::VectorXd::Constant(1, q), Eigen::VectorXd::Constant(1, speed), kGravity, e);
  return e.mass(0, 0) * acceleration + e.bias[0];
}

TEST_F(Dynamics, EquationsOfAPendulum) {
  const Body body(pendulum(), {"a"});
  // Turning about y lifts the rod towards -x: the weight turns it back.
  for (const double q : {-1.0, 0.0, 0.4, 2.0})
    EXPECT_NEAR(torque_of(body, q, 3, 1.5), kInertia * 1.5 + kMass * kG * kArm * std::sin(q), 1e-12) << q;
}

// The period of a free swing: 4 sqrt(I / m g d) K(sin(amplitude / 2)).
double period(const Body& body, double amplitude, double step) {
  Motion motion(body, Eigen::VectorXd::Constant(1, amplitude), Eigen::VectorXd::Zero(1));
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(1);
  double time = 0;
  while (time < 10) {  // down to the lowest point: a quarter
    const double before = motion.joints()[0];
    motion.step(none, step);
    time += step;
    if (motion.joints()[0] <= 0)
      return 4 * (time - step * motion.joints()[0] / (motion.joints()[0] - before));
  }
  return 0;
}
TEST_F(Dynamics, FreePendulumHasItsPeriod) {
  const Body body(pendulum(), {"a"});
  for (const double amplitude : {0.05, 1.0, 2.5}) {
    const double exact =
        4 * std::sqrt(kInertia / (kMass * kG * kArm)) * std::comp_ellint_1(std::sin(amplitude / 2));
    const double coarse = period(body, amplitude, 1e-3) - exact, fine = period(body, amplitude, 5e-4) - exact;
    EXPECT_LT(std::abs(fine), 2e-3 * exact) << amplitude;
    EXPECT_NEAR(coarse / fine, 2, 0.1) << amplitude;  // first order
  }
}

TEST_F(Dynamics, EnergyIsTheWorkOfTheTorques) {
  const Body body(chain(), {"a", "b", "c"});
  const auto drift = [&](double step, bool driven) {
    Motion motion(body, Eigen::Vector3d(1.2, -0.5, 0.8), Eigen::Vector3d(0.3, 0, -1));
    const double before = motion.energy();
    double work = 0, worst = 0;
    for (int i = 0; i < std::lround(1.5 / step); ++i) {
      const double t = i * step;
      const Eigen::Vector3d torques =
          driven ? Eigen::Vector3d(3 * std::sin(5 * t), -2 * std::cos(3 * t), 1) : Eigen::Vector3d(0, 0, 0);
      const Eigen::VectorXd from = motion.joints();
      motion.step(torques, step);
      work += torques.dot(motion.joints() - from);
      worst = std::max(worst, std::abs(motion.energy() - before - work));
    }
    return worst;
  };
  for (const bool driven : {false, true}) {
    const double coarse = drift(1e-3, driven), fine = drift(5e-4, driven);
    EXPECT_LT(fine, 0.1) << "of some 20 J";
    EXPECT_NEAR(coarse / fine, 2, 0.2);
  }
}

// The bias's own part, by finite differences of the mass matrix and of the potential energy (Lagrange).
TEST_F(Dynamics, EquationsAreLagranges) {
  const Body body(chain(), {"a", "b", "c"});
  Rng rng(Seed(1).child("lagrange"));
  const auto random = [&] {
    return Eigen::Vector3d(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1));
  };
  const auto mass = [&](const Eigen::VectorXd& q) {
    Equations e;
    body.equations(q, Eigen::VectorXd::Zero(3), Eigen::Vector3d::Zero(), e);
    return e.mass;
  };
  constexpr double kStep = 1e-5;
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::VectorXd q = random(), v = random();
    Eigen::VectorXd expected = (mass(q + kStep * v) - mass(q - kStep * v)) * v / (2 * kStep);
    for (int k = 0; k < 3; ++k) {
      Eigen::VectorXd up = q, down = q;
      up[k] += kStep;
      down[k] -= kStep;
      expected[k] -= v.dot((mass(up) - mass(down)) * v) / (4 * kStep);
      expected[k] +=
          body.mass() * kG * (body.centre_of_mass(up) - body.centre_of_mass(down)).z() / (2 * kStep);
    }
    Equations e;
    body.equations(q, v, kGravity, e);
    EXPECT_LT((e.bias - expected).norm(), 1e-7);
  }
}

TEST_F(Dynamics, JointsThatFollowAddUp) {
  // A second rod turns twice as far as the first: the same as both moved by hand.
  const std::string parts =
      link("base") + link("one", kRod) + link("two", kRod) + swinging("a", "base", "one", "0 0 0");
  const Body both(load(parts + swinging("b", "one", "two", "0 0 -0.6")), {"a", "b"});
  const Body one(load(parts + swinging("b", "one", "two", "0 0 -0.6",
                                       R"(<mimic joint="a" multiplier="2" offset="0.1"/>)")),
                 {"a"});
  const Eigen::Vector2d follow(1, 2);
  Equations two_joints, one_joint;
  both.equations(Eigen::Vector2d(0.3, 0.7), 1.5 * follow, kGravity, two_joints);
  one.equations(Eigen::VectorXd::Constant(1, 0.3), Eigen::VectorXd::Constant(1, 1.5), kGravity, one_joint);
  EXPECT_NEAR(one_joint.mass(0, 0), follow.dot(two_joints.mass * follow), 1e-12);
  EXPECT_NEAR(one_joint.bias[0], follow.dot(two_joints.bias), 1e-12);
}

// Another link stands still: the same relative motion, seen from there.
TEST_F(Dynamics, GroundMayBeAnyLink) {
  const std::map<std::string, double> rest{{"a", 0.4}, {"b", -0.3}, {"c", 0.5}};
  const RobotModel model = chain();
  const Body body(model, {"a", "b", "c"}, rest), other(model, {"a", "b", "c"}, rest, "two");
  const Eigen::VectorXd posture = body.posture(rest);
  const auto at_rest = body.link_poses(posture), still = other.link_poses(posture);
  for (std::size_t i = 0; i < at_rest.size(); ++i)
    EXPECT_LT((at_rest[i].matrix() - still[i].matrix()).norm(), 1e-12);
  const Eigen::Vector3d q(-0.2, 0.9, 0.1);
  const auto by_root = body.link_poses(q), by_two = other.link_poses(q);
  EXPECT_LT((by_two[2].matrix() - at_rest[2].matrix()).norm(), 1e-12);
  for (std::size_t i = 0; i < by_root.size(); ++i)
    EXPECT_LT((by_root[2].inverse() * by_root[i].matrix() - by_two[2].inverse() * by_two[i].matrix()).norm(),
              1e-12);
  EXPECT_EQ(body.moves(model.link("three")), (std::vector<bool>{true, true, true}));
  EXPECT_EQ(other.moves(model.link("three")), (std::vector<bool>{false, false, true}));
  EXPECT_EQ(other.moves(model.link("base")), (std::vector<bool>{true, true, false}));
  // Energy: the equations hold for the tree turned round, too.
  Motion motion(other, q, Eigen::Vector3d(1, 0, -1));
  const double before = motion.energy();
  for (int i = 0; i < 2000; ++i) motion.step(Eigen::Vector3d::Zero(), 1e-4);
  EXPECT_NEAR(motion.energy(), before, 0.02);
}

// A spring of the joint alone: the closed form of the damped oscillator, however stiff it is.
TEST_F(Dynamics, SpringsAreDampedOscillators) {
  const Body body(pendulum(), {"a"});
  const double k = 80, d = 3, w = std::sqrt(k / kInertia), z = d / (2 * std::sqrt(k * kInertia));
  ASSERT_LT(z, 1);
  const Springs springs{Eigen::ArrayXd::Constant(1, k), Eigen::ArrayXd::Constant(1, d),
                        Eigen::ArrayXd::Zero(1)};
  Motion motion(body, Eigen::VectorXd::Constant(1, 0.2), Eigen::VectorXd::Zero(1), Eigen::Vector3d::Zero());
  const double step = 1e-4, damped = w * std::sqrt(1 - z * z);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(1);
  for (int i = 1; i <= 5000; ++i) {
    motion.step(motion.spring_torques(springs, none, step), step);
    const double t = i * step,
                 exact = 0.2 * std::exp(-z * w * t) *
                         (std::cos(damped * t) + z / std::sqrt(1 - z * z) * std::sin(damped * t));
    ASSERT_NEAR(motion.joints()[0], exact, 1e-3) << t;
  }
  const Springs stiff{springs.stiffness * 1e9, springs.damping * 1e6, springs.rest};
  for (int i = 0; i < 100; ++i) motion.step(motion.spring_torques(stiff, none, 0.01), 0.01);
  EXPECT_NEAR(motion.joints()[0], 0, 1e-6);
}

}  // namespace
}  // namespace hbr
