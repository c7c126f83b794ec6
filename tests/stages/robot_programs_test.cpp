// What the stages of the robots say first of all, called as programs.
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "models/robot/plane/robot_settings.h"
#include "pipeline/artifact/content.h"
#include "pipeline/artifact/repertoire_file.h"
#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class RobotStages : public testing::Test {
 protected:
  std::string file(const std::string& name) const { return (folder_.path() / name).string(); }
  ShellResult run(const std::string& program, const json& settings, const json& inputs) const {
    const json slice = {{"stage", program},
                        {"name", program},
                        {"settings", settings},
                        {"inputs", inputs},
                        {"output", "made.h5"}};
    write_file(file("slice.json"), slice.dump());
    const std::string command = HBR_BINARY_DIR "/bin/" + program + " --root / --slice " + file("slice.json") +
                                " --output " + file("made.h5") + " --checkpoint " + file("checkpoint") +
                                " --threads 1 2>&1";
    return shell(command);
  }
  TemporaryFolder folder_;
};

// Dynamics come last: hours after it could be told that there are none.
TEST_F(RobotStages, ThePlaneTellsOfRobotsWithoutMassesAndArmsWithoutReach) {
  Elites points;
  points.solution = points.measures = Rows::Constant(4, 2, 0.5f);
  points.measures(0, 0) = points.measures(1, 1) = 0.6f;
  points.objective = points.uncertainty = Eigen::VectorXf::Zero(4);
  points.id = {0, 1, 2, 3};
  points.parent = {-1, -1, -1, -1};
  Hdf5Writer arm(file("arm.h5"));
  write_elites(arm, points, {{0, 4, 0, 0, 4}});
  arm.close();
  const std::string inertial =
      "<inertial><mass value=\"1\"/><inertia ixx=\".01\" iyy=\".01\" izz=\".01\" ixy=\"0\" ixz=\"0\" "
      "iyz=\"0\"/></inertial>";
  const auto plane = [&](const std::string& masses) {
    std::string urdf = "<robot name=\"r\"><link name=\"a\"/>";
    for (const auto& [joint, parent, child] :
         {std::tuple("i", "a", "b"), std::tuple("j", "b", "c"), std::tuple("k", "c", "d")})
      urdf += fmt::format(
          "<link name=\"{2}\">{3}</link><joint name=\"{0}\" type=\"revolute\"><parent link=\"{1}\"/>"
          "<child link=\"{2}\"/><origin xyz=\"1 0 0\"/><axis xyz=\"0 0 1\"/>"
          "<limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\"/></joint>",
          joint, parent, child, masses);
    write_file(file("r.urdf"), urdf + "</robot>");
    RobotSettings robot;
    robot.name = "r";
    robot.urdf = file("r.urdf");
    robot.tip_link = "d";
    robot.joints = {"i", "j", "k"};
    robot.off_plane_tolerance = 0.01;
    const json search = {
        {"board", "any"}, {"below_floor", true}, {"samples", 50}, {"refined", 1}, {"points", 20}};
    const json settings = {
        {"seed", 1}, {"half_side", 0.6}, {"robot", settings_to_json(robot)}, {"search", search}};
    return run("robot_plane", settings, {{"layer1", file("arm.h5")}});
  };
  const auto told_of = [&](const std::string& masses) {
    const ShellResult outcome = plane(masses);
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    return outcome.text;
  };
  EXPECT_THAT(told_of(""), HasSubstr("r.urdf: link 'b' and what is fixed to it: the mass is 0 kg; expected "
                                     "more than 0; it can draw, but has no dynamics; `make all` ends at "
                                     "r_dynamics\n"));
  EXPECT_THAT(told_of(inertial), testing::Not(HasSubstr("no dynamics")));

  points.measures.setConstant(0.5f);
  Hdf5Writer still(file("arm.h5"));
  write_elites(still, points, {{0, 4, 0, 0, 4}});
  still.close();
  const ShellResult refused = plane("");
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.text, HasSubstr("arm.h5: all 4 points of the arm are at its shoulder"));
}

TEST_F(RobotStages, AShapeOfNoBodyIsRefused) {
  const json settings = {
      {"half_side", 0.6}, {"shape", {{"triangles", 1000}, {"deviation", 0.001}}}, {"body", json::object()}};
  const ShellResult outcome = run("robot_shape", settings, json::object());
  EXPECT_EQ(outcome.code, 2) << outcome.text;
  EXPECT_THAT(outcome.text, HasSubstr("robot_shape: body is neither an arm nor a robot"));
}

}  // namespace
}  // namespace hbr
