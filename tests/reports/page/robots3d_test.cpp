#include "reports/page/robots3d.h"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>

#include "pipeline/core/check.h"
#include "pipeline/core/random.h"
#include "tests/reports/page/small_shape.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/unpacked.h"

namespace hbr {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

class Robots3d : public testing::Test {
 protected:
  Robots3d() {
    for (const char* robot : {"arm", "legs", "nao"}) shape(robot);
    for (const char* robot : {"legs", "nao"})
      for (const char* replication : {"00", "01"}) drawn(robot, replication);
    for (const char* replication : {"00", "01"}) Hdf5Writer(named("explorer/", replication)).close();
    fs::create_directories(three());
    for (const char* name : {"LICENSE", "OrbitControls.js", "three.module.min.js"})
      std::ofstream(three() / name) << name << " </script>";
  }
  fs::path three() const { return folder_.path() / "three"; }
  Artifacts artifacts() const { return Artifacts(paths_); }

  fs::path place(const std::string& name) {
    fs::create_directories((folder_.path() / name).parent_path());
    return paths_[name] = folder_.path() / name;
  }
  fs::path named(const std::string& stage, const std::string& replication) {
    return place(stage + replication + ".h5");
  }

  void shape(const std::string& robot) {
    Hdf5Writer file(place(robot + "_shape.h5"));
    write_small_shape(file);
    for (const char* list : {"pen/place", "plane/origin", "plane/u", "plane/v"})
      file.write(list, std::vector<double>{1, 0, 0});
    file.attribute("pen_part", std::int64_t{1});
    file.attribute("plane_scale", 0.25);
    file.attribute("half_side", 0.6);
    file.close();
  }

  void drawn(const std::string& robot, const std::string& replication) {
    const std::vector<std::int64_t> id{10, 20, 30, 40};
    Hdf5Writer ways(named(robot + "_ways/", replication));
    ways.write("id", id);
    ways.write("points", std::vector<std::int32_t>{1, 2, 0, 3});
    ways.write("way", std::vector<std::int32_t>{0, 1, 2, 1, 0, 2});
    ways.write("joints", {3, 1}, std::vector<float>{0.1f, 0.2f, 0.3f}.data());
    ways.write("smooth", std::vector<std::uint8_t>{0, 1, 0, 0});
    ways.close();
    Hdf5Writer transfer(named(robot + "_transfer/", replication));
    transfer.write("id", id);
    transfer.write("absolute", std::vector<float>{0.01f, 0.02f, 0.03f, 0.04f});
    transfer.close();
    if (robot == "legs") return;
    Hdf5Writer dynamics(named(robot + "_dynamics/", replication));
    dynamics.write("id", std::vector<std::int64_t>{30, 10});
    for (const std::string player : {"arm", "whole"}) {  // the whole body counts
      const std::uint8_t bad = player == "whole";
      dynamics.write(player + "/off_board", std::vector<std::uint8_t>{bad, 0});
      dynamics.write(player + "/beyond_limit", std::vector<std::uint8_t>{0, 0});
      dynamics.write(player + "/lost", std::vector<std::uint8_t>{bad, 0});
    }
    dynamics.close();
  }

  Unpacked unpack(const std::string& name) const {
    return Unpacked(robots_3d_packs(artifacts(), three()), name);
  }

  TemporaryFolder folder_;
  std::map<std::string, fs::path> paths_;
};

TEST_F(Robots3d, ListsNaoFirstAndTheArmLast) {
  const nlohmann::json words = unpack("robots3d").header["words"];
  std::vector<std::string> titles;
  for (const auto& robot : words["robots"]) titles.push_back(robot["title"]);
  EXPECT_THAT(titles, ElementsAre("NAO", "Legs", "Planar arm"));
  EXPECT_EQ(words["replications"], nlohmann::json({"00", "01"}));
}

TEST_F(Robots3d, KeepsFramesExactlyAndSurfacesToAStepOfTheirBox) {
  const Unpacked robot = unpack("robot-nao");
  const nlohmann::json& words = robot.header["words"];
  EXPECT_EQ(words["parts"][1]["offset"].get<double>(), 1. / 3);
  EXPECT_EQ(words["parts"][1]["origin"][0].get<double>(), 12. / 7);
  EXPECT_EQ(words["parts"][1]["slides"], true);
  const auto places = robot.read<std::uint16_t>("position");
  const auto normals = robot.read<std::uint8_t>("normal");
  ASSERT_EQ(places.size(), kSmallPositions.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const nlohmann::json& piece = words["pieces"][i < 9 ? 0 : 1];
    const double low = piece["low"][i % 3], high = piece["high"][i % 3];
    const double step = (high - low) / words["places"].get<double>();
    EXPECT_NEAR(low + step * places[i], kSmallPositions[i], step / 2 + 1e-7) << i;
    EXPECT_NEAR((normals[i] - 128) / 127., kSmallNormals[i], 0.5 / 127 + 1e-6) << i;
  }
  EXPECT_THAT(robot.read<std::uint16_t>("triangle"), ElementsAre(0, 1, 2, 0, 1, 2, 0, 2, 3));
}

TEST_F(Robots3d, TellsOfEachDigitWhatTransferAndServosFound) {
  const Unpacked ways = unpack("ways-nao-01");
  EXPECT_THAT(ways.read<std::uint16_t>("points"), ElementsAre(1, 2, 0, 3));
  EXPECT_THAT(ways.read<std::uint16_t>("way"), ElementsAre(0, 1, 2, 1, 0, 2));
  const auto steps = ways.read<std::int32_t>("joints");
  ASSERT_EQ(steps.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(steps[i] * ways.header["words"]["step"].get<double>(), 0.1 * (static_cast<double>(i) + 1),
                2.1e-6);
  EXPECT_THAT(ways.read<float>("absolute"), ElementsAre(0.01f, 0.02f, 0.03f, 0.04f));
  EXPECT_THAT(ways.read<std::uint8_t>("servos"), ElementsAre(1, 0, 11, 0));
  EXPECT_THAT(unpack("ways-legs-00").read<std::uint8_t>("servos"), ElementsAre(0, 0, 0, 0));
}

TEST_F(Robots3d, RefusesWaysOfOtherDigits) {
  Hdf5Writer transfer(folder_.path() / "nao_transfer/00.h5");
  transfer.write("id", std::vector<std::int64_t>{10, 20, 30, 50});
  transfer.close();
  EXPECT_THROW(robots_3d_packs(artifacts(), three()), InputError);
}

TEST_F(Robots3d, ShowsOnlyReplicationsThatAllRobotsHave) {
  paths_.erase("legs_ways/00.h5");
  EXPECT_EQ(unpack("robots3d").header["words"]["replications"], nlohmann::json({"01"}));
}

TEST_F(Robots3d, SaysWhereThreeIsNotThereThatItIsNot) {
  EXPECT_EQ(robots_3d_packs(artifacts(), ""), "");
  EXPECT_THAT(robots_3d_html(artifacts(), ""), HasSubstr("three.js could not be had"));
  EXPECT_THAT(robots_3d_html(artifacts(), three()), HasSubstr("id=\"robots3d\""));
  EXPECT_EQ(robots_3d_html(Artifacts({}), three()), "");
  EXPECT_EQ(robots_3d_packs(Artifacts({}), three()), "");
}

}  // namespace
}  // namespace hbr
