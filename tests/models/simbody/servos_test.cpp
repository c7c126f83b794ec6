// Dynamics: closed forms, conservation, and what must not move.
#include "models/simbody/servos.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "pipeline/core/random.h"
#include "tests/models/simbody/urdf_text.h"

namespace hbr {
namespace {

constexpr double kG = 9.80665;

// A rod that turns about y: mass 2 kg, its centre 0.3 m below the joint, inertia 0.05 kg m^2 about it.
constexpr double kMass = 2, kArm = 0.3, kInertia = 0.05 + kMass * kArm * kArm;
std::string swinging(const std::string& name, const std::string& parent, const std::string& child,
                     const std::string& origin, const std::string& more = "") {
  return fmt::format(
      "<joint name=\"{}\" type=\"revolute\"><parent link=\"{}\"/><child link=\"{}\"/><origin xyz=\"{}\"/>"
      "<axis xyz=\"0 1 0\"/><limit lower=\"-3\" upper=\"3\" effort=\"9\" velocity=\"4\"/>{}</joint>\n",
      name, parent, child, origin, more);
}
const std::string kRod = R"(<inertial><origin xyz="0 0 -0.3"/><mass value="2"/>)"
                         R"(<inertia ixx="0.05" iyy="0.05" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial>)";

class Dynamics : public testing::Test {
 protected:
  RobotModel load(const std::string& inside) const {
    return load_urdf(folder_.write("r.urdf", robot(inside)));
  }
  RobotModel pendulum() const {
    return load(link("base") + link("rod", kRod) + link("tip", "") + swinging("a", "base", "rod", "0 0 0") +
                "<joint name=\"end\" type=\"fixed\"><parent link=\"rod\"/><child link=\"tip\"/><origin "
                "xyz=\"0 0 -0.6\"/></joint>");
  }
  // Three rods, each at the end of the one before.
  RobotModel chain() const {
    return load(link("base") + link("one", kRod) + link("two", kRod) + link("three", kRod) +
                swinging("a", "base", "one", "0 0 0") + swinging("b", "one", "two", "0 0.1 -0.6") +
                swinging("c", "two", "three", "0 0 -0.6"));
  }
  // A heavy body with a light arm of two joints, all with strong servos.
  RobotModel body_and_arm() const {
    const auto rod = [](double mass, double inertia) {
      return fmt::format(
          "<inertial><origin xyz=\"0 0 -0.1\"/><mass value=\"{}\"/><inertia ixx=\"{}\" iyy=\"{}\" izz=\"{}\" "
          "ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial>",
          mass, inertia, inertia, inertia);
    };
    return load(
        link("base") + link("one", rod(5, 0.5)) + link("two", rod(0.3, 0.002)) +
        link("three", rod(0.2, 0.001)) + link("tip", "") + swinging("a", "base", "one", "0 0 0") +
        swinging("b", "one", "two", "0 0 -0.2") + swinging("c", "two", "three", "0 0 -0.2") +
        "<joint name=\"end\" type=\"fixed\"><parent link=\"three\"/><child link=\"tip\"/><origin xyz=\"0 "
        "0 -0.2\"/></joint>");
  }
  TestFolder folder_;
};

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

const ServoSettings kServos{0.002, 5, 5, 3};

TEST_F(Dynamics, AServoAtRestStaysAtRest) {
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

TEST_F(Dynamics, ReplayConvergesWithTheStep) {
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

TEST_F(Dynamics, OneJointFollowsItsPath) {
  const Body body(pendulum(), {"a"});
  const JointPath path = wander(1, 0.3f, 2, 0.1, Seed(3));
  const Replay run = replay(body, 2, path, {0}, Eigen::VectorXd::Zero(1), kServos);
  for (std::size_t i = 0; i < run.tip.size(); ++i) EXPECT_LT((run.tip[i] - run.wanted[i]).norm(), 2e-3);
  EXPECT_LT((run.tip.front() - run.wanted.front()).norm(), 1e-15);
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

// The fastest pace, by moving at it: then the greatest share of a limit is 1.
TEST_F(Dynamics, FastestPaceReachesALimit) {
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

TEST_F(Dynamics, StandingStillMayBeTooMuch) {
  const Body body(chain(), {"a", "b", "c"});
  const JointPath path({1.0, 0.0}, {0}, 0.05);
  const Fastest found = fastest(body, path, {1, 2}, Eigen::Vector3d(0.5, 0, 0), 0.01);
  EXPECT_EQ(found.factor, 0);
  EXPECT_TRUE(found.by_torque);
}

TEST_F(Dynamics, LimitsCutTorquesOff) {
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

TEST_F(Dynamics, NoServoDrivesAJointBeyondItsSpeed) {
  // Asked for 10 rad/s, with 4 allowed: the servo stops pushing there.
  const Body body(pendulum(), {"a"});
  const Replay run =
      replay(body, 2, JointPath({0, 2}, {0, 0.2}, 0.05), {0}, Eigen::VectorXd::Zero(1), kServos);
  EXPECT_GT(run.speed[0], 0.95);
  EXPECT_LT(run.speed[0], 1.05);
}

TEST_F(Dynamics, LightJointsAreFound) {
  const std::string feather =
      R"(<inertial><mass value="1e-6"/><inertia ixx="1e-9" iyy="1e-9" izz="1e-9" ixy="0" ixz="0" iyz="0"/></inertial>)";
  const RobotModel model =
      load(link("base") + link("rod", kRod) + link("finger", feather) + link("ghost", "") +
           swinging("a", "base", "rod", "0 0 0") + swinging("b", "rod", "finger", "0 0 -0.6") +
           swinging("c", "finger", "ghost", "0 0 -0.1"));
  EXPECT_EQ(joints_with_inertia(model, {}, 1e-6), (std::vector<std::string>{"a"}));
  EXPECT_EQ(joints_with_inertia(model, {}, 1e-10), (std::vector<std::string>{"a", "b"}));
}

TEST(JointPath, BeginsAndEndsAtRestWithinItsWayPoints) {
  const std::vector<double> joints{0.1, 1, 0.5, -1, -0.3, 0.2}, times{0, 0.32, 0.5};
  const JointPath path(joints, times, 0.05);
  EXPECT_GE(path.duration(), 0.5);
  EXPECT_LE(path.duration(), 0.5 + 4 * 0.05);
  const auto begin = path.at(0), end = path.at(path.duration());
  EXPECT_LT((begin.position - Eigen::Vector2d(0.1, 1)).norm(), 1e-15);
  EXPECT_LT((end.position - Eigen::Vector2d(-0.3, 0.2)).norm(), 1e-15);
  for (const auto& point : {begin, end, path.at(-1), path.at(9)})
    EXPECT_LT(point.velocity.norm() + point.acceleration.norm(), 1e-12);
  constexpr double h = 1e-5;
  for (double t = h; t < path.duration() - h; t += 0.0137) {
    const auto point = path.at(t), before = path.at(t - h), after = path.at(t + h);
    EXPECT_LT(((after.position - before.position) / (2 * h) - point.velocity).norm(), 1e-6);
    EXPECT_LT(((after.velocity - before.velocity) / (2 * h) - point.acceleration).norm(), 0.05);
    EXPECT_LE(point.position[0], 0.5);
    EXPECT_GE(point.position[0], -0.3);
  }
}

TEST(JointPath, GoesStraightWhereItsWayIsStraight) {
  const JointPath path({0, 2}, {0, 2}, 0.1);
  for (double t = 0.5; t < 1.5; t += 0.01) {
    EXPECT_NEAR(path.at(t).velocity[0], 1, 1e-12);
    EXPECT_NEAR(path.at(t + 0.1).position[0] - path.at(t).position[0], 0.1, 1e-12);
  }
}

TEST(JointPath, KeepsPaceOfPenAndJoints) {
  const std::vector<float> pen{0, 0, 0.3f, 0.4f, 0.3f, 0.4f};
  EXPECT_THAT(times_at_pace(pen, {0, 0, 0.1, 0, 0.1, 3}, 0.25, 2),
              testing::Pointwise(testing::DoubleNear(1e-7), {0., 2., 3.5}));
}

}  // namespace
}  // namespace hbr
