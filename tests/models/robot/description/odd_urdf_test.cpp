// Robots as their makers ship them: what is odd is told in one line with its place, and the rest is read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "models/robot/body/body.h"
#include "pipeline/core/check.h"
#include "tests/models/robot/description/urdf_text.h"

namespace hbr {
namespace {

using testing::ContainsRegex;
using testing::ElementsAre;
using testing::IsEmpty;

const std::string kTurns = R"(<limit lower="-1" upper="1" effort="1" velocity="1"/>)";

std::string shape(const std::string& geometry, const std::string& more = "") {
  return "<visual><geometry>" + geometry + "</geometry>" + more + "</visual>";
}
RobotModel load_with(const std::string& inside) { return load(link("a", inertial() + inside)); }
RobotModel load_joint(const std::string& type, const std::string& inside) {
  return load(link("a") + link("b") + joint("j", "a", "b", type, inside));
}
std::string limits(const std::string& attributes) { return "<limit " + attributes + "/>"; }

TEST(OddShapes, OfNoSizeAreLeftOut) {
  for (const auto& [geometry, words] :
       {std::pair(R"(<box size="1 0 1"/>)", "a.urdf:3: <box> of link 'a' has the size 1 0 1: left out"),
        {R"(<box size="1 -1 1"/>)", "size 1 -1 1"},
        {"<box/>", "size 0 0 0"},
        {R"(<cylinder radius="0" length="1"/>)", "<cylinder> .*size 0 0 1"},
        {R"(<cylinder radius="1"/>)", "size 1 1 0"},
        {R"(<sphere radius="0"/>)", "<sphere> .*size 0 0 0"},
        {R"(<capsule radius="-1" length="1"/>)", "size -1 -1 1"},
        {R"(<mesh filename="a.obj" scale="1 0 1"/>)", "<mesh> .*scale 1 0 1"},
        {"<mesh/>", "no filename: left out"},
        {R"(<cone radius="1"/>)", "<cone> of link 'a' is no shape of a URDF: left out; expected"},
        {"", "<visual> of link 'a' has no shape: left out"}}) {
    const RobotModel model = load_with(shape(geometry) + shape(R"(<sphere radius="1"/>)"));
    EXPECT_THAT(model.odd, ElementsAre(ContainsRegex(words))) << geometry;
    ASSERT_EQ(model.links[0].visuals.size(), 1u) << geometry;
    EXPECT_EQ(model.links[0].visuals[0].kind, Visual::Kind::sphere);
  }
  EXPECT_THAT(load_with("<visual/>").odd, ElementsAre(ContainsRegex("has no shape")));
  // A mirrored mesh is none of them.
  EXPECT_THAT(load_with(shape(R"(<mesh filename="a.obj" scale="-1 1 1"/>)")).odd, IsEmpty());
}

TEST(OddShapes, OfOneKindAreToldOnce) {
  const std::string flat = shape(R"(<box size="1 0 1"/>)");
  EXPECT_THAT(load(link("a", flat + flat) + link("b", flat) + joint("j", "a", "b")).odd,
              ElementsAre(ContainsRegex(":3: <box> of link 'a' .* \\(and 2 more\\)$")));
}

TEST(OddShapes, CapsulesAreDrawnAndNoCollisions) {
  const RobotModel model = load_with(shape(R"(<capsule radius=".1" length=".5"/>)"));
  EXPECT_THAT(model.odd, IsEmpty());
  EXPECT_EQ(model.links[0].visuals[0].kind, Visual::Kind::capsule);
  EXPECT_EQ(model.links[0].visuals[0].size, Eigen::Vector3d(.1, .1, .5));
  EXPECT_THAT(
      load_with(R"(<collision><geometry><capsule radius=".1" length=".5"/></geometry></collision>)").odd,
      ElementsAre(ContainsRegex("<capsule> of link 'a' is no shape of a URDF: the <collision> is left out")));
  EXPECT_THAT(load_with(R"(<collision><geometry><box size="0 0 0"/></geometry></collision>)").odd, IsEmpty());
}

TEST(OddColours, AreShownInAnother) {
  const auto with = [](const std::string& material) {
    return load_with(shape(R"(<sphere radius="1"/>)", material));
  };
  const auto colour = [](const RobotModel& model) { return model.links[0].visuals[0].colour; };
  const RobotModel bytes = with(R"(<material name="m"><color rgba="200 100 0 1"/></material>)");
  EXPECT_THAT(bytes.odd, ElementsAre(ContainsRegex(":3: <color> of link 'a' has rgba '200 100 0 1', taken as "
                                                   "parts of 255; expected numbers from 0 to 1: divide")));
  EXPECT_EQ(colour(bytes), Eigen::Vector3f(200 / 255.f, 100 / 255.f, 0));
  EXPECT_EQ(colour(with(R"(<material name="m"><color rgba="1 0 .5"/></material>)")),
            Eigen::Vector3f(1, 0, .5));
  for (const char* rgba : {"1 0", "red", "-1 0 0 1", "300 0 0 1", "nan 0 0 1", ""}) {
    const RobotModel model = with(fmt::format(R"(<material name="m"><color rgba="{}"/></material>)", rgba));
    EXPECT_THAT(model.odd, ElementsAre(ContainsRegex("expected 4 numbers from 0 to 1, such as"))) << rgba;
    EXPECT_FALSE(colour(model)) << rgba;
  }
  const RobotModel textured = with(R"(<material name="m"><texture filename="wood.png"/></material>)");
  EXPECT_THAT(textured.odd,
              ElementsAre(ContainsRegex("'m' has a texture, which is not drawn, and no colour.*add <color")));
  EXPECT_FALSE(colour(textured));
  EXPECT_THAT(with(R"(<material name="m"/>)").odd, ElementsAre(ContainsRegex("'m' has no colour, here or")));
}

TEST(OddColours, AreFoundByName) {
  const std::string red = R"(<material name="red"><color rgba="1 0 0 1"/></material>)",
                    name = R"(<material name="red"/>)", ball = R"(<sphere radius="1"/>)";
  for (const std::string& text :
       {red + link("a", shape(ball, name)), link("a", shape(ball, name)) + red,
        link("a", shape(ball, name) + shape(ball, red)),
        link("a", shape(ball, R"(<material name="red"><texture/></material>)")) + red}) {
    const RobotModel model = load(text);
    EXPECT_THAT(model.odd, IsEmpty());
    EXPECT_EQ(model.links[0].visuals[0].colour, Eigen::Vector3f(1, 0, 0)) << text;
  }
}

TEST(OddMasses, LetARobotBeLookedAt) {
  EXPECT_THAT(load(link("a", inertial("-1"))).odd,
              ElementsAre(ContainsRegex("<mass> of link 'a' is -1 kg.*left out")));
  EXPECT_FALSE(load(link("a", inertial("-1"))).links[0].inertial);
  for (const char* missing : {"<inertial/>", R"(<inertial><mass value="0"/></inertial>)"}) {
    EXPECT_FALSE(load(link("a", missing)).links[0].inertial) << missing;
    EXPECT_FALSE(load(link("a", missing)).links[0].weightless_inertia) << missing;
  }
  EXPECT_TRUE(load(link("a", inertial("0"))).links[0].weightless_inertia);
  // Moments that are not there are 0; what moves by them has no dynamics.
  const RobotModel model =
      load(link("a") + link("b", R"(<inertial><mass value="2"/><inertia ixx="1"/></inertial>)") +
           joint("j", "a", "b"));
  EXPECT_EQ(model.links[1].inertial->inertia, Eigen::Matrix3d(Eigen::Vector3d(1, 0, 0).asDiagonal()));
  const Body body(model, {"j"});
  EXPECT_EQ(body.link_poses(Eigen::VectorXd::Zero(1)).size(), 2u);
  Equations equations;
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(1);
  EXPECT_THROW(body.equations(zero, zero, {0, 0, 0}, equations), InputError);
}

TEST(OddJoints, StandWhereTheyCannotMove) {
  const Eigen::Isometry3d still = load_joint("fixed", "").joints[0].origin;
  for (const auto& [type, inside, words] :
       {std::tuple("floating", "", ":5: joint 'j' is floating: taken as fixed where it stands at 0"),
        {"planar", R"(<axis xyz="0 0 1"/>)", "is planar: taken as fixed"},
        {"revolute", R"(<axis xyz="0 0 0"/><limit lower="-1" upper="1" effort="1" velocity="1"/>)",
         "<axis> of joint 'j' is 0 0 0, no direction: the joint is taken as fixed"}}) {
    const RobotModel model = load_joint(type, inside);
    EXPECT_THAT(model.odd, ElementsAre(ContainsRegex(words)));
    EXPECT_EQ(model.joints[0].kind, Joint::Kind::fixed) << type;
    EXPECT_EQ(model.joints[0].motion(1).matrix(), still.matrix()) << type;
  }
}

TEST(OddJoints, HaveTheLimitsThatAreMeant) {
  const Joint crossed =
      load_joint("revolute", limits(R"(lower="2" upper="-1" effort="1" velocity="1")")).joints[0];
  EXPECT_EQ(crossed.lower, -1);
  EXPECT_EQ(crossed.upper, 2);
  const Joint turns = load_joint("continuous", limits(R"(velocity="3")")).joints[0];
  EXPECT_EQ(turns.lower, -std::numbers::pi);
  EXPECT_EQ(turns.upper, std::numbers::pi);
  EXPECT_EQ(turns.velocity, 3);
  // Some write limits that nothing comes to.
  const std::string far = R"(lower="-1e4" upper="1e4" effort="1" velocity="1")",
                    near = R"(lower="-720" upper="720" effort="1" velocity="1")";
  const Joint endless = load_joint("revolute", limits(far)).joints[0];
  EXPECT_EQ(endless.kind, Joint::Kind::continuous);
  EXPECT_EQ(endless.lower, -std::numbers::pi);
  EXPECT_EQ(endless.upper, std::numbers::pi);
  EXPECT_EQ(load_joint("revolute", limits(near)).joints[0].upper, 720);
  EXPECT_EQ(load_joint("prismatic", limits(far)).joints[0].upper, 1e4);
  EXPECT_EQ(load_joint("prismatic", limits(R"(upper="2" effort="1" velocity="1")")).joints[0].lower, 0);
  for (const auto& [type, inside, words] :
       {std::tuple("revolute", limits(R"(lower="2" upper="-1" effort="1" velocity="1")"),
                   ":6: <limit> of joint 'j' has lower '2' above upper '-1': exchanged"),
        {"revolute", limits(R"(lower="-1e4" upper="1e4" effort="1" velocity="1")"),
         "has lower '-10000' and upper '10000', more than 300 turns: taken as turning without end"},
        {"revolute", "", "joint 'j' has no <limit>, which it needs to move: taken as standing at 0"},
        {"prismatic", "", "has no <limit>"},
        {"revolute", limits(R"(lower="0" upper="1" velocity="1")"), "names no effort: taken as no limit"},
        {"revolute", limits(R"(lower="0" upper="1" effort="1" velocity="0")"),
         "has velocity '0': taken as no"},
        {"revolute", limits(R"(lower="0" upper="1" effort="-1" velocity="1")"),
         "has effort '-1': taken as no"},
        {"continuous", limits(R"(effort="-1")"), "has effort '-1'"},
        {"revolute", kTurns + R"(<dynamics damping="0" friction="0.2"/>)",
         "<dynamics> of joint 'j' is left out; .* in a profile, in ..robots.gears"},
        {"continuous", R"(<dynamics damping="much"/>)", "<dynamics> of joint 'j' is left out"}})
    EXPECT_THAT(load_joint(type, inside).odd, ElementsAre(ContainsRegex(words)));
  for (const std::string& inside :
       {std::string(), limits(R"(velocity="3")"), limits(R"(effort="0" velocity="0")"),
        limits(R"(lower="-1e4" upper="1e4")"), std::string(R"(<dynamics damping="0.0"/>)")})
    EXPECT_THAT(load_joint("continuous", inside).odd, IsEmpty()) << inside;
  EXPECT_EQ(
      load_joint("revolute", limits(R"(lower="0" upper="1" effort="-1" velocity="-1")")).joints[0].effort, 0);
}

std::string mimic(const std::string& leader, const std::string& more = "") {
  return fmt::format(R"(<mimic joint="{}" {}/>)", leader, more) + kTurns;
}

// Joints i, j, k one after the other, each with what its <joint> holds.
RobotModel three(const std::string& i, const std::string& j, const std::string& k,
                 const std::string& last = "revolute", const std::string& first = "revolute") {
  return load(link("a") + link("b") + link("c") + link("d") + joint("i", "a", "b", first, i) +
              joint("j", "b", "c", "revolute", j) + joint("k", "c", "d", last, k));
}

TEST(OddMimics, FollowWhatMovesBoth) {
  // k = 2 j + 3 = 2 (5 i + 7) + 3, whichever stands first in the file.
  const RobotModel forth =
      three(kTurns, mimic("i", R"(multiplier="5" offset="7")"), mimic("j", R"(multiplier="2" offset="3")"));
  const RobotModel back =
      three(mimic("j", R"(multiplier="2" offset="3")"), mimic("k", R"(multiplier="5" offset="7")"), kTurns);
  for (const auto& [model, last, leader] : {std::tuple(&forth, 2, 0), {&back, 0, 2}}) {
    EXPECT_THAT(model->odd, IsEmpty());
    for (const int follower : {1, last}) {
      EXPECT_EQ(model->joints[follower].mimic, leader);
      EXPECT_EQ(model->joints[follower].multiplier, follower == 1 ? 5 : 10);
      EXPECT_EQ(model->joints[follower].offset, follower == 1 ? 7 : 17);
    }
    EXPECT_THAT(model->independent_joints(), ElementsAre(leader == 0 ? "i" : "k"));
  }
}

TEST(OddMimics, OfNoJointMoveByThemselves) {
  const RobotModel model = three(kTurns, mimic("nobody"), mimic("j"));
  EXPECT_THAT(model.odd,
              ElementsAre(ContainsRegex("<mimic> of joint 'j' names joint 'nobody', which is not in")));
  EXPECT_THAT(model.independent_joints(), ElementsAre("i", "j"));
  EXPECT_EQ(model.joints[2].mimic, 1);
}

TEST(OddMimics, OfFixedJointsStandStill) {
  const RobotModel fixed = three(kTurns, kTurns, R"(<mimic joint="i"/>)", "fixed");
  EXPECT_THAT(fixed.odd,
              ElementsAre(ContainsRegex(":12: <mimic> of joint 'k' is left out: the joint is fixed")));
  EXPECT_LT(fixed.joints[2].mimic, 0);
  // What follows a fixed joint, even by another, stands at its offset.
  const RobotModel model = three("", mimic("i", R"(offset=".5")"),
                                 mimic("j", R"(multiplier="3" offset=".1")"), "revolute", "fixed");
  EXPECT_THAT(model.odd, ElementsAre(ContainsRegex("joint 'j' follows 'i', which is fixed: .*stands at 0.5"),
                                     ContainsRegex("joint 'k' .*stands at 1.6")));
  EXPECT_THAT(model.independent_joints(), IsEmpty());
  Joint free = three(kTurns, kTurns, kTurns).joints[2];
  free.axis = {1, 0, 0};
  EXPECT_LT((model.joints[2].motion(0).matrix() - free.motion(1.6).matrix()).norm(), 1e-12);
}

TEST(OddNames, OfRobotsAreThoseOfTheirFiles) {
  const TestFolder folder;
  for (const char* text :
       {R"(<robot><link name="a"/></robot>)", R"(<robot name=""><link name="a"/></robot>)"}) {
    const RobotModel model = load_urdf(folder.write("arm.urdf", text));
    EXPECT_EQ(model.name, "arm");
    EXPECT_THAT(model.odd, ElementsAre(ContainsRegex("arm.urdf:1: <robot> has no name: called 'arm'")));
  }
}

TEST(OddNumbers, MayHaveBlanksAndLineBreaks) {
  const RobotModel model = load(link("a", R"(<inertial><origin xyz=" 1
 2	+3. "/><mass value="
.5"/><inertia ixx="1e0" iyy="1.0
" izz=" 1"/></inertial>)"));
  EXPECT_THAT(model.odd, IsEmpty());
  EXPECT_EQ(model.links[0].inertial->centre, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(model.links[0].inertial->mass, .5);
}

// The same robot, whose link has the letter u umlaut, in the bytes of an encoding.
std::string wide(const std::u16string& text, bool big) {
  std::string bytes;
  for (const char16_t c : text)
    for (const int byte : {0, 1}) bytes += static_cast<char>(c >> 8 * (byte != big));
  return bytes;
}

TEST(OddEncodings, AreConverted) {
  const TestFolder folder;
  const std::string end = "<robot name=\"t\"><link name=\"gr", rest = "n\"/></robot>";
  const std::u16string u16 = u"<robot name=\"t\"><link name=\"gr\u00fcn\"/></robot>";
  const auto declared = [](const std::string& encoding) {
    return "<?xml version=\"1.0\" encoding=\"" + encoding + "\"?>\n";
  };
  const std::string utf8 = end + "\xc3\xbc" + rest, latin = end + "\xfc" + rest;
  for (const auto& [name, bytes, words] :
       {std::tuple("plain", utf8, ""),
        {"marked", "\xef\xbb\xbf" + utf8, ""},
        {"declared", declared("UTF-8") + utf8, ""},
        {"small", declared("utf8") + utf8, ""},
        {"latin1", declared("ISO-8859-1") + latin, ""},
        {"windows", declared("windows-1252") + latin, ""},
        {"utf16le", "\xff\xfe" + wide(u16, false), ""},
        {"utf16be", "\xfe\xff" + wide(u16, true), ""},
        {"unmarked", wide(u16, false), ""},
        {"undeclared", "\n" + latin, ":2: not UTF-8, which XML is without"},
        {"wrong", declared("utf-8") + latin, ":2: not utf-8, which the first"},
        {"unknown", declared("ANSI-X") + utf8, "read as UTF-8"}}) {
    const RobotModel model = load_urdf(folder.write("a.urdf", bytes));
    EXPECT_EQ(model.links[0].name, "gr\xc3\xbcn") << name;
    if (*words)
      EXPECT_THAT(model.odd, ElementsAre(ContainsRegex(words))) << name;
    else
      EXPECT_THAT(model.odd, IsEmpty()) << name;
  }
}

}  // namespace
}  // namespace hbr
