// make robot's program, called as from a shell.
#include <gmock/gmock.h>

#include "tests/end_to_end/fake_folder.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

class RobotProgram : public testing::Test {
 protected:
  ShellResult robot(const std::string& arguments) const {
    return shell("cd " HBR_SOURCE_DIR " && " HBR_BINARY_DIR "/bin/robot " + arguments);
  }
  TemporaryFolder folder_;
};

TEST_F(RobotProgram, TellsAndShowsWhatARobotIs) {
  const fs::path out = folder_.path() / "out";
  const ShellResult told = robot("models/industrial/six_joint_arm.urdf " + out.string() + " \"\" elbow=0.5");
  EXPECT_EQ(told.code, 0) << told.text;
  for (const char* words :
       {"links: 8, joints: 7, of them moving by themselves: 6",
        "\nelbow      revolute  upper_arm -> fore_arm", "mass    67.5000 kg", "\nheight  ",
        "\nreach   1.236 m from joint 'turn' to 'pen'", "\nboards  of 'pen', largest squares about: level ",
        " m, upright ", " m, leaning "})
    EXPECT_THAT(told.text, HasSubstr(words));
  for (const auto& [name, magic] : {std::pair("six_joint_arm.png", "\x89PNG"),
                                    {"six_joint_arm_reach.png", "\x89PNG"},
                                    {"six_joint_arm_boards.png", "\x89PNG"},
                                    {"six_joint_arm.glb", "glTF"},
                                    {"six_joint_arm.html", "<!do"}}) {
    std::ifstream file(out / name, std::ios::binary);
    std::string begin(4, ' ');
    file.read(begin.data(), 4);
    EXPECT_EQ(begin, magic) << name;
  }
  EXPECT_FALSE(fs::exists(out / "six_joint_arm.shape.h5"));
#ifdef NDEBUG  // under sanitizers the page is the same, and the browser is not ours
  const ShellResult browser =
      shell("node " HBR_SOURCE_DIR "/tests/browser/robot_page.mjs " + (out / "six_joint_arm.html").string());
  EXPECT_EQ(browser.code, 0) << browser.text;
#endif
}

TEST_F(RobotProgram, SaysWhatNoJointCanDo) {
  const std::string arm = "models/industrial/six_joint_arm.urdf " + folder_.path().string() + " \"\" ";
  const ShellResult told = robot(arm + "elbow=0.5 shoulder=50");
  EXPECT_EQ(told.code, 0) << told.text;
  EXPECT_THAT(told.text, HasSubstr("\nodd: joint \'shoulder\' can\'t stand at 50: it moves in ["));
  EXPECT_THAT(told.text, testing::Not(HasSubstr("odd: joint \'elbow\'")));
}

// NAO's meshes are made by a stage, or here.
TEST_F(RobotProgram, MakesNaosMeshes) {
  const ShellResult told = robot("models/nao/nao.urdf " + folder_.path().string());
  EXPECT_EQ(told.code, 0) << told.text;
  EXPECT_THAT(told.text, testing::Not(HasSubstr("mesh")));
  EXPECT_THAT(told.text, HasSubstr("\nboards  of 'r_gripper', largest squares about: level 0."))
      << "a hand opens";
  EXPECT_GT(fs::file_size(folder_.path() / "nao.glb"), 500000u);  // rods are a hundred thousand
}

TEST_F(RobotProgram, ShowsWhatIsOdd) {
  const fs::path urdf = folder_.path() / "odd.urdf";
  std::ofstream(urdf) << "<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?>\n<robot>\n<link name=\"gr\xfcn\">\n"
                         "<inertial><mass value=\"1\"/></inertial><visual><geometry><box size=\"1 1 0\"/>"
                         "</geometry></visual></link>\n<link name=\"b\"/>\n<link name=\"c\"/>\n"
                         "<joint name=\"j\" type=\"continuous\"><parent link=\"gr\xfcn\"/><child link=\"b\"/>"
                         "<origin xyz=\"0 0 1\"/></joint>\n"
                         "<joint name=\"k\" type=\"floating\"><parent link=\"b\"/><child link=\"c\"/></joint>"
                         "</robot>\n";
  const ShellResult told = robot(urdf.string() + " " + folder_.path().string());
  EXPECT_EQ(told.code, 0) << told.text;
  for (const std::string words :
       {"odd.urdf:2: <robot> has no name: called 'odd'",
        "odd.urdf:4: <box> of link 'gr\xc3\xbcn' has the size", "odd.urdf:8: joint 'k' is floating",
        "links 'gr\xc3\xbcn', 'b': principal moments of inertia 0, 0, 0 kg m^2",
        "none, as a joint alone moves it along a curve"})
    EXPECT_THAT(told.text, HasSubstr(words));
}

// OUT may be the folder in which the robot's own files lie, but for those that would be overwritten.
TEST_F(RobotProgram, OverwritesNothingThatItReads) {
  const fs::path arm = folder_.path() / "arm.urdf", mesh = folder_.path() / "arm.glb";
  const ShellResult made = robot("models/industrial/six_joint_arm.urdf " + folder_.path().string());
  ASSERT_EQ(made.code, 0) << made.text;
  fs::rename(folder_.path() / "six_joint_arm.glb", mesh);
  std::ofstream(arm) << "<robot name=\"arm\"><link name=\"a\"><visual><geometry><mesh filename=\"arm.glb\"/>"
                        "</geometry></visual></link></robot>";
  const auto written = fs::last_write_time(mesh);
  const ShellResult told = robot(arm.string() + " " + folder_.path().string());
  EXPECT_EQ(told.code, 2);
  EXPECT_THAT(told.text,
              HasSubstr("arm.glb is a file of the robot, and would be overwritten; give another folder"));
  EXPECT_EQ(fs::last_write_time(mesh), written);
  EXPECT_EQ(robot(arm.string() + " " + (folder_.path() / "out").string()).code, 0);
}

TEST_F(RobotProgram, RefusesInOneLine) {
  const std::string out = folder_.path().string(), arm = "models/industrial/six_joint_arm.urdf ",
                    nao = "models/nao/nao.urdf ";
  for (const auto& [arguments, words] :
       {std::pair("\"\" " + out, "no URDF is named; expected make robot URDF="),
        {"none.urdf " + out, "none.urdf: can"},
        {arm + out + " \"\" elbow=much", "expected JOINT=POSITION"},
        {arm + out + " \"\" knee=1", "no joint"},
        {arm + out + " \"\" elbow=1 elbow=2", "its joint is given twice"},
        {arm + out + " \"\" pen_mount=1", "joint 'pen_mount' is fixed"},
        {nao + out + " \"\" RHipYawPitch=.1", "follows joint 'LHipYawPitch'"},
        {arm + "/proc/no", "/proc/no: can"},
        {arm + "/dev/null/no",
         "/no: can\'t make this folder: Not a directory; something above it is no folder"}}) {
    const ShellResult told = robot(arguments + " 2>&1 >/dev/null");
    EXPECT_EQ(told.code, 2) << told.text;
    EXPECT_THAT(told.text, HasSubstr(words));
    EXPECT_EQ(std::count(told.text.begin(), told.text.end(), '\n'), 1) << told.text;
  }
}

}  // namespace
}  // namespace hbr
