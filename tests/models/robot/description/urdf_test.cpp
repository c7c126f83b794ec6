// Every way in which a URDF can be wrong ends in one clear line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "models/robot/description/robot_model.h"
#include "pipeline/core/check.h"
#include "tests/models/robot/description/urdf_text.h"

namespace hbr {
namespace {

const std::string kLimit = R"(<limit lower="-1" upper="1" effort="1" velocity="1"/>)";

struct Bad {
  std::string name, text, expected;
};
// gtest prints a parameter with this.
void PrintTo(const Bad& bad, std::ostream* out) { *out << bad.name; }

std::string visual(const std::string& more) {
  return inertial() + "<visual>" + more + "<geometry><sphere radius=\"1\"/></geometry></visual>";
}

std::string two_links(const std::string& second) { return robot(link("a") + second); }

std::vector<Bad> bad_urdfs() {
  const std::string ab = link("a") + link("b");
  return {
      {"Empty", "", "not XML"},
      {"NotXml", "solid cube", "not XML"},
      {"Torn", "<robot name=\"a\"><link name=\"b\">", "not XML"},
      {"NoRobot", "<sdf version=\"1\"></sdf>", "no <robot>.*found <sdf>"},
      {"OnlyOpening", std::string(400000, '<'), "not XML"},
      {"NestedElements",
       [] {
         std::string s;
         for (int i = 0; i < 9000; ++i) s += "<a>";
         return s;
       }(),
       "nested"},
      {"NoRobotName", "<robot><link name=\"a\"/></robot>", "name"},
      {"NoLink", robot(""), "no <link>"},
      {"NamelessLink", robot("<link/>"), "a <link> has no 'name'"},
      {"TwinLinks", robot(link("a") + link("a")), "second link 'a'"},
      {"TwinJoints", robot(ab + link("c") + joint("j", "a", "b") + joint("j", "b", "c")), "second joint 'j'"},
      {"NameOfTwoLines", robot(ab + joint("j\nk", "a", "b", "ball")),
       "a <joint> has a control character in its name 'j k'"},
      {"NamelessJoint", robot(ab + joint("", "a", "b")), "a <joint> has no 'name'"},
      {"UnknownType", robot(ab + joint("j", "a", "b", "ball")), "joint 'j' has type 'ball'.*prismatic"},
      {"Floating", robot(ab + joint("j", "a", "b", "floating")), "type 'floating'"},
      {"Planar", robot(ab + joint("j", "a", "b", "planar")), "type 'planar'"},
      {"NoType", robot(ab + "<joint name=\"j\"><parent link=\"a\"/><child link=\"b\"/></joint>"),
       "no 'type'"},
      {"NoParent", robot(ab + "<joint name=\"j\" type=\"fixed\"><child link=\"b\"/></joint>"), "no <parent"},
      {"NoChild", robot(ab + "<joint name=\"j\" type=\"fixed\"><parent link=\"b\"/></joint>"), "no <child"},
      {"BrokenChain", robot(ab + joint("j", "a", "c")), "child of joint 'j' is link 'c'.*broken"},
      {"BrokenChainAbove", robot(ab + joint("j", "c", "b")), "parent of joint 'j' is link 'c'.*broken"},
      {"TwoRoots", robot(ab), "2 links hang on no joint \\('a', 'b'\\)"},
      {"TwoParents", robot(ab + link("c") + joint("j", "a", "c") + joint("k", "b", "c")), "two joints"},
      {"Cycle", robot(ab + joint("j", "a", "b") + joint("k", "b", "a")), "cycle"},
      {"CycleBesideTheTree", robot(ab + link("c") + joint("j", "b", "c") + joint("k", "c", "b")), "cycle"},
      {"OwnParent", robot(ab + joint("j", "b", "b")), "cycle"},
      {"NoMass", two_links(link("b", inertial("0")) + joint("j", "a", "b")), "link 'b': the mass is 0"},
      {"NegativeMass", two_links(link("b", inertial("-1")) + joint("j", "a", "b")), "the mass is -1"},
      {"MassIsNotANumber", two_links(link("b", inertial("heavy")) + joint("j", "a", "b")), "mass"},
      {"MassNan", two_links(link("b", inertial("nan")) + joint("j", "a", "b")), ":4: value of <mass>.*'nan'"},
      {"MassWithALetter", two_links(link("b", inertial("1.0abc")) + joint("j", "a", "b")),
       ":4: value of <mass> in link 'b' is '1.0abc'; expected a number"},
      {"MassTooLarge", two_links(link("b", inertial("1e999")) + joint("j", "a", "b")), ":4: .*'1e999'"},
      {"MassOfTwoNumbers", two_links(link("b", inertial("1 2")) + joint("j", "a", "b")), ":4: .*'1 2'"},
      {"InertiaIncomplete", two_links(link("b", inertial("1", R"(ixx="1" iyy="1")")) + joint("j", "a", "b")),
       "nertia"},
      {"InertiaInWords",
       two_links(link("b", inertial("1", R"(ixx="1" iyy="big" izz="1")")) + joint("j", "a", "b")),
       ":4: iyy of <inertia> in link 'b' is 'big'"},
      {"OriginOfTwo", two_links(link("b", visual(R"(<origin xyz="1 2"/>)")) + joint("j", "a", "b")),
       ":4: xyz of <origin> in link 'b' is '1 2'; expected 3 numbers"},
      {"OriginOfFour", two_links(link("b", visual(R"(<origin xyz="1 2 3 4"/>)")) + joint("j", "a", "b")),
       ":4: .*expected 3 numbers"},
      {"OriginNotFinite", two_links(link("b", visual(R"(<origin xyz="inf 0 0"/>)")) + joint("j", "a", "b")),
       ":4: xyz of <origin> in link 'b' is 'inf 0 0'"},
      {"TurnInWords", two_links(link("b", visual(R"(<origin rpy="0 pi 0"/>)")) + joint("j", "a", "b")),
       ":4: rpy of <origin> in link 'b' is '0 pi 0'"},
      {"ColourOfThree",
       two_links(link("b", visual(R"(<material name="m"><color rgba="1 0 0"/></material>)")) +
                 joint("j", "a", "b")),
       ":4: rgba of <color> in link 'b' is '1 0 0'; expected 4 numbers"},
      {"NoMassElement", two_links(link("b", "<inertial/>") + joint("j", "a", "b")), "nertial"},
      {"ZeroInertia",
       two_links(link("b", inertial("1", R"(ixx="0" iyy="0" izz="0")")) + joint("j", "a", "b")), "above 0"},
      {"NegativeInertia",
       two_links(link("b", inertial("1", R"(ixx="1" iyy="-1" izz="1")")) + joint("j", "a", "b")), "above 0"},
      {"ZeroInertiaOfARod",
       two_links(link("b", inertial("1", R"(ixx="0" iyy="1" izz="1")")) + joint("j", "a", "b")), "above 0"},
      {"NegativeMassFixed", two_links(link("b", inertial("-0.1")) + joint("j", "a", "b", "fixed")),
       "link 'b': the mass is -0.1"},
      {"NoInertiaOfAllThatMoves",
       two_links(link("b", inertial("1", R"(ixx="0" iyy="0" izz="0")")) +
                 link("c", inertial("1", R"(ixx="0" iyy="0" izz="0")")) + joint("j", "a", "b") +
                 joint("k", "b", "c", "fixed")),
       "link 'b' and what is fixed to it: principal moments.*above 0"},
      {"LimitsCrossed",
       robot(ab +
             joint("j", "a", "b", "revolute", R"(<limit lower="1" upper="-1" effort="1" velocity="1"/>)")),
       "joint 'j': the limits are \\[1, -1\\]"},
      {"NoLimits", robot(ab + joint("j", "a", "b", "revolute", "")), "limit"},
      {"NoLimitsPrismatic", robot(ab + joint("j", "a", "b", "prismatic", "")), "limit"},
      {"LimitIsNotANumber",
       robot(ab +
             joint("j", "a", "b", "revolute", R"(<limit lower="x" upper="1" effort="1" velocity="1"/>)")),
       ":6: lower of <limit> in joint 'j' is 'x'"},
      {"LimitNotFinite",
       robot(ab +
             joint("j", "a", "b", "revolute", R"(<limit lower="-inf" upper="1" effort="1" velocity="1"/>)")),
       ":6: lower of <limit>.*'-inf'"},
      {"NoEffort",
       robot(ab + joint("j", "a", "b", "revolute", R"(<limit lower="0" upper="1" velocity="1"/>)")),
       "effort"},
      {"NegativeVelocity",
       robot(ab +
             joint("j", "a", "b", "revolute", R"(<limit lower="0" upper="1" effort="1" velocity="-1"/>)")),
       "velocity -1"},
      {"NegativeEffort",
       robot(ab +
             joint("j", "a", "b", "revolute", R"(<limit lower="0" upper="1" effort="-1" velocity="1"/>)")),
       "effort -1"},
      {"NoAxis", robot(ab + joint("j", "a", "b", "revolute", R"(<axis xyz="0 0 0"/>)" + kLimit)),
       "its axis is 0"},
      {"AxisOfTwo", robot(ab + joint("j", "a", "b", "revolute", R"(<axis xyz="0 1"/>)" + kLimit)),
       "xyz of <axis> in joint 'j' is '0 1'; expected 3 numbers"},
      {"MimicsNothing", robot(ab + joint("j", "a", "b", "revolute", R"(<mimic joint="k"/>)" + kLimit)),
       "mimics joint 'k', which is not in the file"},
      {"MimicsItself", robot(ab + joint("j", "a", "b", "revolute", R"(<mimic joint="j"/>)" + kLimit)),
       "is a mimic joint too"},
      {"MimicsFixed",
       robot(ab + link("c") + joint("k", "a", "b", "fixed") +
             joint("j", "b", "c", "revolute", R"(<mimic joint="k"/>)" + kLimit)),
       "mimics joint 'k', which is fixed"},
      {"MimicsAMimic",
       robot(ab + link("c") + link("d") + joint("k", "a", "b") +
             joint("l", "b", "c", "revolute", R"(<mimic joint="k"/>)" + kLimit) +
             joint("j", "c", "d", "revolute", R"(<mimic joint="l"/>)" + kLimit)),
       "joint 'j' mimics joint 'l', which is a mimic joint too"},
      {"MimicsInWords",
       robot(ab + link("c") + joint("k", "a", "b") +
             joint("j", "b", "c", "revolute", R"(<mimic joint="k" multiplier="twice"/>)" + kLimit)),
       "multiplier of <mimic> in joint 'j' is 'twice'"},
      {"FixedMimics",
       robot(ab + link("c") + joint("k", "a", "b") + joint("j", "b", "c", "fixed", R"(<mimic joint="k"/>)")),
       "'j' is fixed and can't mimic"},
      {"NegativeRadius",
       two_links(link("b", "<visual><geometry><sphere radius=\"-1\"/></geometry></visual>") +
                 joint("j", "a", "b")),
       "size"},
      {"ScaleZero",
       two_links(
           link("b", R"(<visual><geometry><mesh filename="a.obj" scale="1 0 1"/></geometry></visual>)") +
           joint("j", "a", "b")),
       "scale 1, 0, 1"},
      {"MeshWithoutAName",
       two_links(link("b", "<visual><geometry><mesh/></geometry></visual>") + joint("j", "a", "b")),
       "filename"},
      {"UnknownShape",
       two_links(link("b", "<visual><geometry><cone radius=\"1\"/></geometry></visual>") +
                 joint("j", "a", "b")),
       "cone"},
      {"Noise", std::string("\x7f\x45\x4c\x46\x02\x01\x00\xff\xfe", 9), "not XML"},
      {"EmptyBox",
       two_links(link("b", inertial() + R"(<visual><geometry><box size="0 1 1"/></geometry></visual>)") +
                 joint("j", "a", "b")),
       "size"},
      {"NoGeometry", two_links(link("b", inertial() + "<visual/>") + joint("j", "a", "b")), "."},
      {"NotUtf8", std::string("\xff\xfe<\0r\0o\0b\0o\0t\0/\0>\0", 18), "not XML"},
      {"Xacro", two_links("<link name=\"b\"><xacro:inertia mass=\"1\"/></link>" + joint("j", "a", "b")),
       ":4: <xacro:inertia>: this is a xacro"},
      {"HugeMass", two_links(link("b", inertial("1e308")) + joint("j", "a", "b")),
       ":4: value of <mass>.*expected a number within 1e.15"},
      {"HugeInertia",
       two_links(link("b", inertial("1", R"(ixx="1e200" iyy="1e200" izz="1e200")")) + joint("j", "a", "b")),
       "ixx of <inertia>.*within 1e.15"},
      {"HugeOrigin", two_links(link("b", visual(R"(<origin xyz="0 0 -1e200"/>)")) + joint("j", "a", "b")),
       "xyz of <origin>.*3 numbers within 1e.06"},
      {"HugeAxis", robot(ab + joint("j", "a", "b", "revolute", R"(<axis xyz="1e200 0 0"/>)" + kLimit)),
       "xyz of <axis>"},
      {"HugeLimits",
       robot(ab + joint("j", "a", "b", "prismatic",
                        R"(<limit lower="-1e308" upper="1e308" effort="1" velocity="1"/>)")),
       "lower of <limit>.*within 1e.18"},
      {"HugeMimic",
       robot(ab + link("c") + joint("k", "a", "b") +
             joint("j", "b", "c", "prismatic", R"(<mimic joint="k" multiplier="1e300"/>)" + kLimit)),
       "multiplier of <mimic>"},
      {"HugeScale",
       two_links(
           link("b", R"(<visual><geometry><mesh filename="a.obj" scale="1e300 1 1"/></geometry></visual>)") +
           joint("j", "a", "b")),
       "scale of <mesh>"},
      {"HugeSphere",
       two_links(link("b", "<visual><geometry><sphere radius=\"1e30\"/></geometry></visual>") +
                 joint("j", "a", "b")),
       "radius of <sphere>"},
      {"LinkOfTwoLines", robot(link("a\nb")), "a <link> has a control character in its name 'a b'"},
      {"MeshOfTwoLines",
       two_links(link("b", "<visual><geometry><mesh filename=\"a&#10;b.obj\"/></geometry></visual>") +
                 joint("j", "a", "b")),
       "name of a mesh, 'a b.obj', holds a control character"},
      {"EndlessName", robot(link(std::string(3000, 'x')) + link(std::string(3000, 'x'))), "xxx \\.\\.\\.$"},
      {"MimicsInACircle",
       robot(ab + link("c") + joint("k", "a", "b", "revolute", R"(<mimic joint="j"/>)" + kLimit) +
             joint("j", "b", "c", "revolute", R"(<mimic joint="k"/>)" + kLimit)),
       "is a mimic joint too"},
      {"BadVersion", "<robot name=\"a\" version=\"x\"><link name=\"a\"/></robot>", "ersion"},
  };
}

class BadUrdf : public testing::TestWithParam<Bad> {};

TEST_P(BadUrdf, IsRefusedInOneLine) {
  const TestFolder folder;
  const auto path = folder.write("bad.urdf", GetParam().text);
  testing::internal::CaptureStderr();
  try {
    load_urdf(path);
    ADD_FAILURE() << "taken without a word";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::ContainsRegex(GetParam().expected));
    EXPECT_THAT(error.what(), testing::HasSubstr("bad.urdf"));
    EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("\n")));
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

INSTANTIATE_TEST_SUITE_P(Urdf, BadUrdf, testing::ValuesIn(bad_urdfs()),
                         [](const auto& test) { return test.param.name; });

TEST(Urdf, WhatIsNoFileIsRefused) {
  const TestFolder folder;
  ASSERT_EQ(mkfifo((folder.path() / "pipe.urdf").c_str(), 0600), 0);
  for (const auto& path : {folder.path() / "missing.urdf", folder.path(), folder.path() / "pipe.urdf",
                           std::filesystem::path("/dev/zero")}) {
    try {
      load_urdf(path);
      ADD_FAILURE() << path << " taken without a word";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::StartsWith(path.string() + ": can't be read"));
    }
  }
}

}  // namespace
}  // namespace hbr
