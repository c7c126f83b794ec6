// What the artifacts of robots have to do with each other and with the arm's, by brute force.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/artifact/repertoire_file.h"

namespace hbr {

class RobotArtifacts {
 public:
  explicit RobotArtifacts(std::filesystem::path out) : out_(std::move(out)) {}

  // Digits drawn by both: the arm's are layer 4's, the differences those of the images, to a grey value.
  void expect_transfer(const std::string& robot) const {
    const Hdf5Reader file = of(robot + "_transfer");
    const Images arm = images(file, "arm"), drawn = images(file, "robot");
    EXPECT_EQ(arm, images(of("layer4"), "image"));
    EXPECT_NE(arm, drawn);
    EXPECT_EQ(file.read<std::int64_t>("id").values, of("layer4").read<std::int64_t>("id").values);
    const auto absolute = file.read<float>("absolute").values, squared = file.read<float>("squared").values;
    ASSERT_EQ(absolute.size(), drawn.size());
    for (std::size_t i = 0; i < absolute.size(); ++i) {
      EXPECT_NEAR(absolute[i], difference(arm[i], drawn[i], 1), 1 / 255.) << i;
      EXPECT_NEAR(squared[i], difference(arm[i], drawn[i], 2), 2 / 255.) << i;
    }
  }

  // Servos begin with digits that the transfer drew, and differ from those.
  void expect_dynamics(const std::string& robot) const {
    const Hdf5Reader file = of(robot + "_dynamics"), transfer = of(robot + "_transfer");
    const Images before = images(file, "image"), drawn = images(transfer, "robot");
    const auto id = file.read<std::int64_t>("id").values, all = transfer.read<std::int64_t>("id").values;
    ASSERT_EQ(id.size(), before.size());
    for (std::size_t i = 0; i < id.size(); ++i)
      EXPECT_EQ(before[i], drawn.at(static_cast<std::size_t>(std::ranges::find(all, id[i]) - all.begin())));
    for (const std::string player : {"wanted", "arm", "whole"}) {
      if (!file.has(player + "/image")) continue;
      const Images after = images(file, player + "/image");
      const auto absolute = file.read<float>(player + "/absolute").values;
      for (std::size_t i = 0; i < id.size(); ++i)
        EXPECT_NEAR(absolute[i], difference(before[i], after[i], 1), 1 / 255.) << player << i;
      if (player == "wanted") continue;
      const auto rms = file.read<float>(player + "/rms").values,
                 most = file.read<float>(player + "/max").values,
                 off = file.read<float>(player + "/off_plane").values;
      for (std::size_t i = 0; i < id.size(); ++i) {
        EXPECT_LE(rms[i], most[i]);
        EXPECT_LT(off[i], 1) << "m of the robot";
      }
      if (player == "arm") {
        EXPECT_LT(*std::ranges::max_element(rms), 0.02f) << "m of the robot";
      }
    }
  }

  // What was tuned, beside what it was before: the transfer's digits.
  void expect_tuned(const std::string& robot) const {
    const Hdf5Reader file = of(robot + "_tuned"), layer4 = of("layer4");
    const Images arm = images(file, "arm/image");
    EXPECT_EQ(arm, images(layer4, "image"));
    const Elites digits = read_elites(path("layer4"));
    for (const std::string state : {"before", "top", "all"}) {
      const bool before = state == "before";
      const Images drawn = images(file, state + "/image");
      const auto nearest = file.read<std::int32_t>(state + "/nearest").values;
      const auto objective = file.read<float>(state + "/objective").values,
                 absolute = file.read<float>(state + "/absolute").values;
      EXPECT_EQ(file.read<std::uint8_t>(state + "/good").values.size(), drawn.size());
      ASSERT_EQ(nearest.size(), arm.size());
      for (std::size_t i = 0; i < nearest.size(); ++i)
        EXPECT_NEAR(absolute[i], difference(arm[i], drawn.at(static_cast<std::size_t>(nearest[i])), 1), 1e-6);
      if (before) continue;
      const Elites tuned = read_elites(path(robot + "_tuned_" + state));
      EXPECT_EQ(drawn, images(of(robot + "_tuned_" + state), "image"));
      EXPECT_EQ(objective, std::vector<float>(tuned.objective.begin(), tuned.objective.end()));
      ASSERT_EQ(drawn.size(), objective.size());
      for (std::size_t i = 0; i < nearest.size(); ++i) {
        const auto place = digits.measures.row(static_cast<Eigen::Index>(i));
        const float distance = (tuned.measures.row(nearest[i]) - place).norm();
        for (Eigen::Index k = 0; k < tuned.size(); ++k)
          EXPECT_GE((tuned.measures.row(k) - place).norm(), distance - 1e-6f);
      }
    }
    EXPECT_EQ(images(file, "before/image"), robot == "arm" ? arm : images(of(robot + "_transfer"), "robot"));
    // Other lines and arcs answer at the same places.
    for (const char* name : {"line", "arc_centre", "arc_length"}) {
      const auto before = file.read<float>(std::string("before/") + name),
                 all = file.read<float>(std::string("all/") + name);
      EXPECT_EQ(before.shape, all.shape) << name;
      EXPECT_NE(before.values, all.values) << name;
    }
    EXPECT_EQ(file.read<float>("all/arc_fitness").values.size(),
              static_cast<std::size_t>(read_elites(path(robot + "_tuned_arcs")).size()));
    const std::vector<float> of_arm(digits.objective.begin(), digits.objective.end());
    EXPECT_EQ(file.read<float>("before/objective").values == of_arm, robot == "arm");
    if (robot == "arm") expect_control(file);
  }

 private:
  using Images = std::vector<std::vector<std::uint8_t>>;

  // The arm itself in the robot's place.
  static void expect_control(const Hdf5Reader& file) {
    for (const char* name : {"absolute", "line_from_arm", "arc_centre_from_arm", "arc_length_from_arm"})
      for (const float none : file.read<float>(std::string("before/") + name).values)
        EXPECT_EQ(none, 0) << name;
  }

  static double difference(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b,
                           int power) {
    double sum = 0;
    for (std::size_t p = 0; p < a.size(); ++p) {
      const double d = std::abs(static_cast<double>(a[p]) - static_cast<double>(b[p])) / 255;
      sum += power == 1 ? d : d * d;
    }
    return sum / static_cast<double>(a.size());
  }
  static Images images(const Hdf5Reader& file, const std::string& name) {
    const auto read = file.read<std::uint8_t>(name);
    const std::size_t pixels = read.shape.at(1) * read.shape.at(2);
    Images result;
    for (auto at = read.values.begin(); at != read.values.end(); at += static_cast<std::ptrdiff_t>(pixels))
      result.emplace_back(at, at + static_cast<std::ptrdiff_t>(pixels));
    return result;
  }
  std::filesystem::path path(const std::string& stage) const { return out_ / stage / "00.h5"; }
  Hdf5Reader of(const std::string& stage) const { return Hdf5Reader(path(stage)); }

  std::filesystem::path out_;
};

}  // namespace hbr
