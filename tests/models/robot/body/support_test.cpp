// What bears a robot: its weight, its momentum, and where the ground pushes.
#include "models/robot/body/support.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "models/robot/body/servos.h"
#include "pipeline/core/check.h"
#include "tests/models/robot/body/rods.h"

namespace hbr {
namespace {

class SupportTest : public RodsTest {
 protected:
  // A foot of 3 kg on the floor, half a metre below the root, and a column of rods above it.
  RobotModel standing(const std::string& of_b = "") const {
    const std::string foot =
        R"(<inertial><origin xyz="0.02 0.01 0.1"/><mass value="3"/>)"
        R"(<inertia ixx="0.02" iyy="0.03" izz="0.04" ixy="0" ixz="0" iyz="0"/></inertial>)";
    return load(link("base") + link("one", kRod) + link("two", kRod) + link("foot", foot) +
                swinging("a", "base", "one", "0 0 0") + swinging("b", "one", "two", "0 0.1 -0.1", of_b) +
                swinging("c", "base", "foot", "0 0 -0.5"));
  }
  static double infinity() { return std::numeric_limits<double>::infinity(); }
};

const std::vector<Eigen::Vector3d> kSquare{{-1, -1, -2}, {1, -1, -2}, {1, 1, -2}, {-1, 1, -2}, {5, 5, 3}};

TEST_F(SupportTest, MarginIsTheDistanceToTheSolesEdge) {
  const Support square(kSquare, 0.01);
  EXPECT_EQ(square.floor(), -2);
  EXPECT_EQ(square.corners().size(), 4u);
  EXPECT_NEAR(square.margin(Eigen::Vector2d(0, 0)), 1, 1e-15);
  EXPECT_NEAR(square.margin(Eigen::Vector2d(0.7, -0.2)), 0.3, 1e-15);
  EXPECT_NEAR(square.margin(Eigen::Vector2d(1.5, 0)), -0.5, 1e-15);
  EXPECT_NEAR(square.margin(Eigen::Vector2d(1.3, 1.4)), -0.5, 1e-15);
  // A place above the others counts when it is near enough to the floor; one inside changes nothing.
  std::vector<Eigen::Vector3d> more = kSquare;
  more.insert(more.end(), {{3, 0, -1.99}, {0.2, 0.1, -2}, {0, 1, -2}});
  EXPECT_EQ(Support(more, 0.005).corners().size(), 4u);
  EXPECT_NEAR(Support(more, 0.02).margin(Eigen::Vector2d(2, 0)), 0.5 / std::hypot(1, 0.5), 1e-12);
}

TEST_F(SupportTest, ASoleHasAnArea) {
  for (const std::vector<Eigen::Vector3d>& places :
       {std::vector<Eigen::Vector3d>{}, {{0, 0, 0}}, {{0, 0, 0}, {1, 1, 0}, {2, 2, 0}}})
    EXPECT_THAT([&] { Support(places, 0.01); },
                testing::ThrowsMessage<InputError>(testing::HasSubstr("expected a sole of three or more")));
}

TEST_F(SupportTest, TheGroundPushesUnderTheCentreOfMass) {
  const std::map<std::string, double> rest{{"a", 0.4}, {"b", -0.3}, {"c", 0.2}};
  const Body body(standing(), {"a", "b", "c"}, rest, "foot");
  const Support support(kSquare, 0.01);
  for (const double turn : {-0.5, 0.2, 1.1}) {
    const Eigen::Vector3d q(turn, 0.3, 0.2 - turn);
    const Wrench reaction = body.reaction(q, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), kGravity);
    EXPECT_LT((reaction.force - body.mass() * Eigen::Vector3d(0, 0, kG)).norm(), 1e-12);
    EXPECT_LT((support.centre_of_pressure(reaction) - body.centre_of_mass(q).head<2>()).norm(), 1e-12);
    EXPECT_EQ(needed_grip(reaction), 0);
  }
}

// The ground's force is the change of the momentum less the weight, its moment that of the angular momentum,
// both by finite differences of where masses are.
void expect_change_of_momentum(const Body& body, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                               const Eigen::VectorXd& a) {
  constexpr double kStep = 1e-3;
  const auto at = [&](double t) { return Eigen::VectorXd(q + t * v + t * t / 2 * a); };
  // Momentum, and angular momentum about the origin.
  const auto momentum = [&](double t) {
    const auto before = body.link_poses(at(t - kStep)), now = body.link_poses(at(t)),
               after = body.link_poses(at(t + kStep));
    Eigen::Vector<double, 6> sum = Eigen::Vector<double, 6>::Zero();
    for (std::size_t i = 0; i < body.model().links.size(); ++i) {
      if (!body.model().links[i].inertial) continue;
      const Inertial& in = *body.model().links[i].inertial;
      const Eigen::Vector3d p = in.mass * (after[i] * in.centre - before[i] * in.centre) / (2 * kStep);
      const Eigen::AngleAxisd turn(Eigen::Matrix3d(after[i].linear() * before[i].linear().transpose()));
      const Eigen::Matrix3d inertia = now[i].linear() * in.inertia * now[i].linear().transpose();
      sum.head<3>() += p;
      sum.tail<3>() += (now[i] * in.centre).cross(p) + inertia * turn.axis() * turn.angle() / (2 * kStep);
    }
    return sum;
  };
  const Eigen::Vector<double, 6> change = (momentum(kStep) - momentum(-kStep)) / (2 * kStep);
  const Wrench reaction = body.reaction(q, v, a, kGravity);
  const Eigen::Vector3d weight = body.mass() * kGravity;
  EXPECT_LT((reaction.force - (change.head<3>() - weight)).norm(), 1e-3);
  EXPECT_LT((reaction.moment - (change.tail<3>() - body.centre_of_mass(q).cross(weight))).norm(), 1e-3);
  EXPECT_GT(change.norm(), 5);
}

TEST_F(SupportTest, ReactionsAreTheChangeOfMomentum) {
  const std::map<std::string, double> rest{{"b", -0.3}, {"c", 0.5}};
  expect_change_of_momentum(Body(standing(), {"a", "b", "c"}, rest, "foot"), Eigen::Vector3d(0.3, -0.8, 0.4),
                            Eigen::Vector3d(1.5, -2, 0.7), Eigen::Vector3d(-3, 4, 6));
  // A joint that follows another.
  expect_change_of_momentum(
      Body(standing(R"(<mimic joint="a" multiplier="2" offset="0.1"/>)"), {"a", "c"}, rest, "foot"),
      Eigen::Vector2d(0.3, 0.4), Eigen::Vector2d(1.5, 0.7), Eigen::Vector2d(-3, 6));
}

TEST_F(SupportTest, TheGroundDoesNotPull) {
  const Support support(kSquare, 0.01);
  EXPECT_EQ(support.margin(Wrench{{0, 0, 0}, {0, 0, -1}}), -infinity());
  EXPECT_EQ(needed_grip({{0, 0, 0}, {1, 0, 0}}), infinity());
  EXPECT_NEAR(needed_grip({{0, 0, 0}, {3, 4, 10}}), 0.5, 1e-15);
}

// A servo that swings its rod fast needs a longer sole than one that is slow.
TEST_F(SupportTest, ReplaysTellHowTheyStand) {
  const Body body(standing(), {"a", "b", "c"}, {}, "foot");
  const Support support({{-0.1, -0.1, -0.5}, {0.1, -0.1, -0.5}, {0.1, 0.2, -0.5}, {-0.1, 0.2, -0.5}}, 0.01);
  const auto stood = [&](double seconds) {
    return replay(body, 2, JointPath({0, 0, 0.4, 0.4, 0, 0}, {0, seconds, 2 * seconds}, seconds / 4), {0, 1},
                  Eigen::Vector3d::Zero(), {0.002, 5, 5, 3}, {{}, &support});
  };
  const Replay slow = stood(4), fast = stood(0.3);
  EXPECT_GT(slow.margin, 0);
  EXPECT_LT(slow.margin, 0.1);
  EXPECT_LT(fast.margin, slow.margin);
  EXPECT_GT(fast.grip, slow.grip);
  const Replay bolted =
      replay(body, 2, JointPath({0, 0}, {0}, 0.05), {0, 1}, Eigen::Vector3d::Zero(), {0.002, 5, 5, 3});
  EXPECT_EQ(bolted.margin, infinity());
}

}  // namespace
}  // namespace hbr
