#include "models/robot/body/robot_facts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/models/robot/body/flat_joints.h"
#include "tests/models/robot/description/urdf_text.h"

namespace hbr {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;

const std::string kNao = HBR_SOURCE_DIR "/models/nao/nao.urdf";

TEST(RobotFacts, TableHasARowForEachJoint) {
  const std::string table = joint_table(load_urdf(kNao));
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 30);
  EXPECT_THAT(table, HasSubstr("\nRHipYawPitch    revolute  torso -> RPelvis        0 0.707 0.707   -1.145"));
  EXPECT_THAT(table, HasSubstr("3.35  1 * LHipYawPitch + 0\n"));
  const auto limits = [](const std::string& words) {
    return joint_table(load(link("a") + link("b") + at(0, "j", "a", "b", words)));
  };
  EXPECT_THAT(limits(R"(<limit lower="-1" upper="1" velocity="2" effort="3"/>)"), EndsWith(" 2       3\n"));
  EXPECT_THAT(limits(R"(<limit lower="-1" upper="1" velocity="0" effort="0"/>)"),
              EndsWith(" none    none\n"));
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
  EXPECT_THAT(odd(good + link("c", "") + at(0, "k", "b", "c", limit(-1, 1))),
              ElementsAre(HasSubstr("links 'c': the mass is 0 kg")));
  EXPECT_THAT(
      odd(good + link("c") + at(0, "k", "b", "c", R"(<mimic joint="j" multiplier="3"/>)" + limit(-1, 1))),
      ElementsAre(HasSubstr("'k' follows 'j' to [-3.000, 3.000], beyond its own limits [-1.000, 1.000]: "
                            "'j' moves in [-0.333, 0.333]")));
  EXPECT_THAT(odd(good, 500), testing::Contains(HasSubstr("millimetres")));
  EXPECT_THAT(odd(good, .5),
              ElementsAre(HasSubstr("link 'a': 1 kg with the inertia"), HasSubstr("link 'b'")));
}

}  // namespace
}  // namespace hbr
