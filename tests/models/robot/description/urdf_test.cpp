// Every way in which a URDF can be wrong ends in one clear line.
#include <fmt/format.h>
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

std::string first_and(const std::string& second) { return robot(link("a") + second); }

std::vector<Bad> bad_urdfs() {
  const std::string ab = link("a") + link("b");
  return {
      {"Empty", "", "not XML"},
      {"NotXml", "solid cube", "not XML"},
      {"Torn", "<robot name=\"a\"><link name=\"b\">", "is an element not closed?"},
      {"NoRobot", "<sdf version=\"1\"></sdf>", "no <robot>.*found <sdf>"},
      {"OnlyOpening", std::string(400000, '<'), "not XML"},
      {"NestedElements",
       [] {
         std::string s;
         for (int i = 0; i < 9000; ++i) s += "<a>";
         return s;
       }(),
       "nested"},
      {"NoLink", robot(""), "no <link>"},
      {"NamelessLink", robot("<link/>"), "a <link> has no 'name'"},
      {"TwinLinks", robot(link("a") + link("a")), "second link 'a'"},
      {"TwinJoints", robot(ab + link("c") + joint("j", "a", "b") + joint("j", "b", "c")), "second joint 'j'"},
      {"NameOfTwoLines", robot(ab + joint("j\nk", "a", "b", "ball")),
       "a <joint> has a control character in its name 'j k'"},
      {"NamelessJoint", robot(ab + joint("", "a", "b")), "a <joint> has no 'name'"},
      {"UnknownType", robot(ab + joint("j", "a", "b", "ball")), "joint 'j' has type 'ball'.*prismatic"},
      {"NoType", robot(ab + "<joint name=\"j\"><parent link=\"a\"/><child link=\"b\"/></joint>"),
       "joint 'j' has type ''; expected revolute, "},
      {"MisspeltLink", robot(link("arm") + link("hand") + joint("j", "arm", "hnad")),
       "the chain is broken .did you mean 'hand'"},
      {"NoParent", robot(ab + "<joint name=\"j\" type=\"fixed\"><child link=\"b\"/></joint>"), "no <parent"},
      {"NoChild", robot(ab + "<joint name=\"j\" type=\"fixed\"><parent link=\"b\"/></joint>"), "no <child"},
      {"BrokenChain", robot(ab + joint("j", "a", "c")), "child of joint 'j' is link 'c'.*broken"},
      {"BrokenChainAbove", robot(ab + joint("j", "c", "b")), "parent of joint 'j' is link 'c'.*broken"},
      {"TwoRoots", robot(ab), "2 links hang on no joint \\('a', 'b'\\)"},
      {"TwoParents", robot(ab + link("c") + joint("j", "a", "c") + joint("k", "b", "c")), "two joints"},
      {"Cycle", robot(ab + joint("j", "a", "b") + joint("k", "b", "a")), "cycle"},
      {"CycleBesideTheTree", robot(ab + link("c") + joint("j", "b", "c") + joint("k", "c", "b")), "cycle"},
      {"OwnParent", robot(ab + joint("j", "b", "b")), "cycle"},
      {"MassIsNotANumber", first_and(link("b", inertial("heavy")) + joint("j", "a", "b")), "mass"},
      {"MassNan", first_and(link("b", inertial("nan")) + joint("j", "a", "b")),
       ":4: <mass> of link 'b' has value 'nan'"},
      {"MassWithALetter", first_and(link("b", inertial("1.0abc")) + joint("j", "a", "b")),
       ":4: <mass> of link 'b' has value '1.0abc'; expected a number within .*such as"},
      {"MassTooLarge", first_and(link("b", inertial("1e999")) + joint("j", "a", "b")), ":4: .*'1e999'"},
      {"MassOfTwoNumbers", first_and(link("b", inertial("1 2")) + joint("j", "a", "b")), ":4: .*'1 2'"},
      {"InertiaInWords",
       first_and(link("b", inertial("1", R"(ixx="1" iyy="big" izz="1")")) + joint("j", "a", "b")),
       ":4: <inertia> of link 'b' has iyy 'big'"},
      {"OriginOfTwo", first_and(link("b", visual(R"(<origin xyz="1 2"/>)")) + joint("j", "a", "b")),
       ":4: <origin> of link 'b' has xyz '1 2'; expected 3 numbers within .*such as"},
      {"OriginOfFour", first_and(link("b", visual(R"(<origin xyz="1 2 3 4"/>)")) + joint("j", "a", "b")),
       ":4: .*expected 3 numbers"},
      {"OriginNotFinite", first_and(link("b", visual(R"(<origin xyz="inf 0 0"/>)")) + joint("j", "a", "b")),
       ":4: <origin> of link 'b' has xyz 'inf 0 0'"},
      {"TurnInWords", first_and(link("b", visual(R"(<origin rpy="0 pi 0"/>)")) + joint("j", "a", "b")),
       ":4: <origin> of link 'b' has rpy '0 pi 0'"},
      {"LimitIsNotANumber",
       robot(ab +
             joint("j", "a", "b", "revolute", R"(<limit lower="x" upper="1" effort="1" velocity="1"/>)")),
       ":6: <limit> of joint 'j' has lower 'x'"},
      {"LimitNotFinite",
       robot(ab +
             joint("j", "a", "b", "revolute", R"(<limit lower="-inf" upper="1" effort="1" velocity="1"/>)")),
       ":6: <limit> of joint 'j' has lower '-inf'"},
      {"AxisOfTwo", robot(ab + joint("j", "a", "b", "revolute", R"(<axis xyz="0 1"/>)" + kLimit)),
       "<axis> of joint 'j' has xyz '0 1'; expected 3 numbers"},
      {"MimicsItself", robot(ab + joint("j", "a", "b", "revolute", R"(<mimic joint="j"/>)" + kLimit)),
       ":5: joint 'j' never comes to [^']*'j' -> 'j' is a loop"},
      {"MimicsInWords",
       robot(ab + link("c") + joint("k", "a", "b") +
             joint("j", "b", "c", "revolute", R"(<mimic joint="k" multiplier="twice"/>)" + kLimit)),
       "<mimic> of joint 'j' has multiplier 'twice'"},
      {"Noise", std::string("\x7f\x45\x4c\x46\x02\x01\x00\xff\xfe", 9), "not XML"},
      {"Utf16OfNoRobot", std::string("\xff\xfe<\0r\0o\0b\0o\0t\0/\0>\0", 18), ":1: the robot has no <link>"},
      {"Xacro", first_and("<link name=\"b\"><xacro:inertia mass=\"1\"/></link>" + joint("j", "a", "b")),
       ":4: <xacro:inertia>: this is a xacro"},
      {"HugeMass", first_and(link("b", inertial("1e308")) + joint("j", "a", "b")),
       ":4: <mass> of link 'b' has value '1e308'; expected a number within 1e.15"},
      {"HugeInertia",
       first_and(link("b", inertial("1", R"(ixx="1e200" iyy="1e200" izz="1e200")")) + joint("j", "a", "b")),
       "<inertia> of link 'b' has ixx .*within 1e.15"},
      {"HugeOrigin", first_and(link("b", visual(R"(<origin xyz="0 0 -1e200"/>)")) + joint("j", "a", "b")),
       "<origin> of link 'b' has xyz .*3 numbers within 1e.06"},
      {"HugeAxis", robot(ab + joint("j", "a", "b", "revolute", R"(<axis xyz="1e200 0 0"/>)" + kLimit)),
       "<axis> of joint 'j' has xyz"},
      {"HugeLimits",
       robot(ab + joint("j", "a", "b", "prismatic",
                        R"(<limit lower="-1e308" upper="1e308" effort="1" velocity="1"/>)")),
       "<limit> of joint 'j' has lower .*within 1e.18"},
      {"HugeMimic",
       robot(ab + link("c") + joint("k", "a", "b") +
             joint("j", "b", "c", "prismatic", R"(<mimic joint="k" multiplier="1e300"/>)" + kLimit)),
       "<mimic> of joint 'j' has multiplier"},
      {"HugeScale",
       first_and(
           link("b", R"(<visual><geometry><mesh filename="a.obj" scale="1e300 1 1"/></geometry></visual>)") +
           joint("j", "a", "b")),
       "<mesh> of link 'b' has scale"},
      {"HugeSphere",
       first_and(link("b", "<visual><geometry><sphere radius=\"1e30\"/></geometry></visual>") +
                 joint("j", "a", "b")),
       "<sphere> of link 'b' has radius"},
      {"LinkOfTwoLines", robot(link("a\nb")), "a <link> has a control character in its name 'a b'"},
      {"MeshOfTwoLines",
       first_and(link("b", "<visual><geometry><mesh filename=\"a&#10;b.obj\"/></geometry></visual>") +
                 joint("j", "a", "b")),
       "control character in its filename 'a b.obj'"},
      {"EndlessName", robot(link(std::string(3000, 'x')) + link(std::string(3000, 'x'))), "xxx \\.\\.\\.$"},
      {"MimicsInACircle",
       robot(ab + link("c") + link("d") + joint("i", "a", "b", "revolute", R"(<mimic joint="j"/>)" + kLimit) +
             joint("j", "b", "c", "revolute", R"(<mimic joint="k"/>)" + kLimit) +
             joint("k", "c", "d", "revolute", R"(<mimic joint="j"/>)" + kLimit)),
       ":7: joint 'i' never comes to [^']*'j' -> 'k' -> 'j' is a loop"},
      {"MimicsItsFollower",
       robot(ab + link("c") + joint("j", "a", "b", "revolute", R"(<mimic joint="k"/>)" + kLimit) +
             joint("k", "b", "c", "revolute", R"(<mimic joint="j"/>)" + kLimit)),
       ": joint 'j' never comes to [^']*'j' -> 'k' -> 'j' is a loop"},
      {"TooManyLinks",
       [] {
         std::string all = link("l0");
         for (int i = 1; i <= 1000; ++i)
           all += link(fmt::format("l{}", i)) +
                  joint(fmt::format("j{}", i), fmt::format("l{}", i - 1), fmt::format("l{}", i));
         return robot(all);
       }(),
       ": 1001 links; expected at most 1000"},
      {"MimicsByTooMuch",
       robot(
           ab + link("c") + link("d") + link("e") + joint("i", "a", "b") +
           joint("j", "b", "c", "revolute", R"(<mimic joint="i" multiplier="1e6"/>)" + kLimit) +
           joint("k", "c", "d", "revolute", R"(<mimic joint="j" multiplier="1e6"/>)" + kLimit) +
           joint("l", "d", "e", "revolute", R"(<mimic joint="k" multiplier="1e6" offset="1e6"/>)" + kLimit) +
           link("f") + joint("m", "e", "f", "revolute", R"(<mimic joint="l" multiplier="-1e6"/>)" + kLimit)),
       "joint 'm' follows 'i' by multiplier -1e.24"},
      {"UnknownEncoding", "<?xml version=\"1.0\" encoding=\"EBCDIC-X\"?><robot name=\"a\xfc\"/>",
       ":1: the encoding 'EBCDIC-X' is unknown here; expected UTF-8"},
      {"TornUtf16", std::string("\xff\xfe<\0r\0o\0b\0o", 11),
       "begins as UTF-16LE, but is not from byte 10 on"},
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
