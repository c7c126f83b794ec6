// What a robot looks like is part of its picture's key: the URDF and every mesh that it names.
#include <gmock/gmock.h>

#include <fmt/format.h>

#include <fstream>

#include "pipeline/artifact/freshness.h"
#include "stages/plan/experiment.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

namespace fs = std::filesystem;

class RobotLooks : public testing::Test {
 protected:
  RobotLooks() {
    fs::create_directories(folder_.path() / "mine");
    write("robot_picture", "a program");
    write("a.obj", "v 0 0 0\nmtllib a.mtl\n");
    write("a.mtl", "Kd 1 0 0\n");
    write("mine/a.obj", "v 1 0 0\n");
    urdf("a.obj");
  }
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_.path() / name) << text;
    return folder_.path() / name;
  }
  void urdf(const std::string& mesh) const {
    write("r.urdf", "<robot name=\"r\"><link name=\"a\"><visual><geometry><mesh filename=\"" + mesh +
                        "\"/></geometry></visual></link></robot>");
  }
  Node picture(const std::string& meshes = "") const {
    const fs::path profile = write(
        "mine.toml",
        fmt::format(
            "base = \"{}\"\nname = \"mine\"\n[[robots]]\nname = \"r\"\nurdf = \"{}\"\nmeshes = \"{}\"\n"
            "mesh_scale = 1\ntip_link = \"a\"\nstands_on = \"\"\njoints = [\"j\"]\nrest_joints = []\n"
            "rest_positions = []\noff_plane_tolerance = 0.001\n",
            HBR_SOURCE_DIR "/stages/profiles/paper.toml", (folder_.path() / "r.urdf").string(), meshes));
    for (const Node& node : experiment_graph(profile))
      if (node.stage == "r_picture") return node;
    ADD_FAILURE() << "no picture";
    return {};
  }
  std::string key(const std::string& meshes = "") const {
    const Workspace workspace{folder_.path() / "out", folder_.path(), folder_.path()};
    HashCache hashes(workspace);
    return freshness_of(workspace, picture(meshes), {}, hashes).key;
  }
  TemporaryFolder folder_;
};

TEST_F(RobotLooks, ChangeThePicturesKey) {
  const std::string before = key();
  EXPECT_EQ(key(), before);
  write("a.obj", "v 0 0 1\nmtllib a.mtl\n");
  const std::string moved = key();
  EXPECT_NE(moved, before);
  write("a.mtl", "Kd 0 1 0\n");
  const std::string painted = key();
  EXPECT_NE(painted, moved);
  write("mine/a.obj", "v 2 0 0\n");  // another folder's
  EXPECT_EQ(key(), painted);

  const std::string folder = (folder_.path() / "mine").string(), named = key(folder);
  write("mine/a.obj", "v 3 0 0\n");
  EXPECT_NE(key(folder), named);
}

TEST_F(RobotLooks, OfAUrdfThatIsBadOrGoneDoNotStopTheExperiment) {
  const std::vector<std::string> alone{(folder_.path() / "r.urdf").string()};
  EXPECT_EQ(picture().sources.size(), 3u);
  urdf("none.obj");
  EXPECT_EQ(picture().sources, alone);
  write("r.urdf", "no URDF");
  EXPECT_EQ(picture().sources, alone);
  fs::remove(folder_.path() / "r.urdf");
  EXPECT_EQ(picture().sources, alone);
}

}  // namespace
}  // namespace hbr
