#include "models/robot/body/robot_facts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/models/robot/description/urdf_text.h"

namespace hbr {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string kNao = HBR_SOURCE_DIR "/models/nao/nao.urdf";

std::string at(double x, const std::string& name, const std::string& parent, const std::string& child,
               const std::string& more) {
  return fmt::format(
      R"(<joint name="{}" type="{}"><parent link="{}"/><child link="{}"/><origin xyz="{} 0 0"/>)"
      R"(<axis xyz="0 0 1"/>{}</joint>)",
      name, more.empty() ? "fixed" : "revolute", parent, child, x, more);
}
std::string limit(double lower, double upper, double velocity = 1) {
  return fmt::format(R"(<limit lower="{}" upper="{}" effort="1" velocity="{}"/>)", lower, upper, velocity);
}

TEST(RobotFacts, TableHasARowForEachJoint) {
  const std::string table = joint_table(load_urdf(kNao));
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 30);
  EXPECT_THAT(table, HasSubstr("\nRHipYawPitch    revolute  torso -> RPelvis        0 0.707 0.707   -1.145"));
  EXPECT_THAT(table, HasSubstr("3.35  1 * LHipYawPitch + 0\n"));
}

// NAO's hand: the arm's closed form is farthest where elbow and forearm are as straight as the limits let
// them.
TEST(RobotFacts, ReachIsTheFarthestPoint) {
  double farthest = 0;
  for (double roll = .0349066; roll < .2; roll += 1e-6) {  // of the elbow; its yaw turns the offset upwards
    const double x = .1137 * std::cos(roll) + .105, y = .1137 * std::sin(roll), h = .01231, o = .015;
    for (const double yaw : {-2.08567, -1.5, -1., 0., 1., 1.5, 2.08567}) {
      const double b = std::cos(yaw) * y + std::sin(yaw) * h - o, c = std::sin(yaw) * y - std::cos(yaw) * h;
      farthest = std::max(farthest, std::sqrt(x * x + b * b + c * c));
    }
  }
  bool found = false;
  for (const ChainReach& reach : chain_reaches(load_urdf(kNao))) {
    if (reach.link != "r_gripper") continue;
    found = true;
    EXPECT_EQ(reach.joint, "RShoulderPitch");
    EXPECT_NEAR(reach.metres, farthest, 1e-4);
    EXPECT_GE(reach.metres, farthest - 1e-9);
  }
  EXPECT_TRUE(found);
  // Two links of 1 m whose elbow bends by no less than 90 degrees.
  const double right = std::acos(0.);
  const RobotModel two =
      load(link("a") + link("b") + link("c") + link("d") + at(0, "j", "a", "b", limit(-1, 1)) +
           at(1, "k", "b", "c", limit(right, 2)) + at(1, "f", "c", "d", ""));
  ASSERT_EQ(chain_reaches(two).size(), 1u);
  EXPECT_NEAR(chain_reaches(two)[0].metres, std::sqrt(2.), 1e-9);
  // The same elbow, held there by what it follows.
  const std::string follows = fmt::format(R"(<mimic joint="j" multiplier="0" offset="{}"/>)", right);
  const RobotModel held =
      load(link("a") + link("b") + link("c") + link("d") + at(0, "j", "a", "b", limit(-1, 1)) +
           at(1, "k", "b", "c", follows + limit(-2, 2)) + at(1, "f", "c", "d", ""));
  EXPECT_NEAR(chain_reaches(held)[0].metres, std::sqrt(2.), 1e-9);
}

TEST(RobotFacts, WhatIsOddIsSaid) {
  const auto odd = [](const std::string& inside, double size = 1) {
    return oddities(load(link("a") + link("b") + inside), size);
  };
  const std::string good = at(0, "j", "a", "b", limit(-1, 1));
  EXPECT_THAT(odd(good), ElementsAre());
  EXPECT_THAT(odd(at(0, "j", "a", "b", limit(.5, .5))), ElementsAre(HasSubstr("'j' can't move")));
  EXPECT_THAT(odd(at(0, "j", "a", "b", limit(.5, 1))), ElementsAre(HasSubstr("'j' can't stand at 0")));
  EXPECT_THAT(odd(at(0, "j", "a", "b", limit(-90, 90))), ElementsAre(HasSubstr("are its limits degrees?")));
  EXPECT_THAT(odd(at(0, "j", "a", "b", limit(-1, 1, 0))), ElementsAre(HasSubstr("'j' has velocity 0")));
  EXPECT_THAT(odd(good + link("c", "") + at(0, "k", "b", "c", limit(-1, 1))),
              ElementsAre(HasSubstr("joint 'k' moves has no mass")));
  EXPECT_THAT(
      odd(good + link("c") + at(0, "k", "b", "c", R"(<mimic joint="j" multiplier="3"/>)" + limit(-1, 1))),
      ElementsAre(HasSubstr("'k' follows 'j' to [-3.000, 3.000], beyond its own limits")));
  EXPECT_THAT(odd(good, 500), testing::Contains(HasSubstr("millimetres")));
  EXPECT_THAT(odd(good, .5),
              ElementsAre(HasSubstr("link 'a': 1 kg with the inertia"), HasSubstr("link 'b'")));
}

}  // namespace
}  // namespace hbr
