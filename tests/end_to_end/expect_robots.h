// What the artifacts of robots have to do with each other and with the arm's, by brute force.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "models/robot/plane/clearance.h"
#include "models/robot/plane/plane_file.h"
#include "models/robot/plane/robot_on_plane.h"
#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/artifact/repertoire_file.h"

namespace hbr {

class RobotArtifacts {
 public:
  explicit RobotArtifacts(std::filesystem::path out) : out_(std::move(out)) {}

  // Elites of layer 1, as evolved and as projected: each is where its joints put the pen, near enough to the
  // plane, and clear of the robot itself and the board. Projection brings them nearer and fills gaps.
  void expect_points(const std::string& name) const {
    const auto settings = nlohmann::json::parse(of(name + "_layer1").text_attribute("settings"));
    auto table = settings_from_json<RobotSettings>(settings.at("body").at("robot"), name);
    table.urdf = std::filesystem::path(HBR_SOURCE_DIR) / table.urdf;
    const double half_side = settings.at("layer").at("half_side");
    const RobotOnPlane robot = make_robot(table, load_plane(out_ / (name + "_plane.h5")));
    const Clearance clearance(robot.body(), robot.tip());
    const Elites evolved = read_elites(path(name + "_layer1")),
                 projected = read_elites(path(name + "_projected"));
    ASSERT_GT(evolved.size(), 0);
    ASSERT_GE(projected.size(), evolved.size());
    for (const Elites* elites : {&evolved, &projected})
      for (Eigen::Index i = 0; i < elites->size(); ++i) {
        Eigen::VectorXd joints(robot.dof());
        for (Eigen::Index j = 0; j < robot.dof(); ++j)
          joints[j] =
              std::lerp(robot.lower()[j], robot.upper()[j], static_cast<double>(elites->solution(i, j)));
        EXPECT_TRUE(clearance.clear(joints.data(), {robot.plane(), half_side})) << i;
        const Pen pen = robot.plane().to_pen(robot.body().position(robot.tip(), joints.data()));
        EXPECT_LE(std::abs(pen.off_plane), table.off_plane_tolerance * 1.001) << i;
        const Eigen::Array2f place = ((pen.position.array() / half_side + 1) / 2).cast<float>();
        EXPECT_LT((elites->measures.row(i).transpose().array() - place).abs().maxCoeff(), 1e-5f) << i;
      }
    const Hdf5Reader file = of(name + "_projected");
    const auto off_before = file.read<float>("before/off_plane").values,
               off_after = file.read<float>("after/off_plane").values,
               gaps_before = file.read<float>("before/nearest").values,
               gaps_after = file.read<float>("after/nearest").values;
    const auto median = [](std::vector<float> values) {
      std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
      return values[values.size() / 2];
    };
    EXPECT_LT(median(off_after), median(off_before));
    ASSERT_EQ(gaps_after.size(), static_cast<std::size_t>(read_elites(path("layer1")).size()));
    EXPECT_LT(median(gaps_after), median(gaps_before));
    const auto spacing = static_cast<float>(file.number_attribute("settings.spacing"));
    const auto within = std::ranges::count_if(gaps_after, [&](float gap) { return gap <= spacing; });
    const double covered = Hdf5Reader(out_ / (name + "_plane.h5")).number_attribute("covered");
    EXPECT_GE(static_cast<double>(within), (covered - 0.02) * static_cast<double>(gaps_after.size()));
  }

  // Digits drawn by both: the arm's are layer 4's, the differences those of the images, to a grey value.
  void expect_transfer(const std::string& robot) const {
    const Hdf5Reader file = of(robot + "_transfer");
    const Images arm = images(file, "arm"), drawn = images(file, "robot");
    EXPECT_EQ(arm, images(of("layer4"), "image"));
    EXPECT_NE(arm, drawn);
    EXPECT_EQ(file.read<std::int64_t>("id").values, of("layer4").read<std::int64_t>("id").values);
    EXPECT_NE(drawn, images(file, "evolved/robot"));
    for (const std::string form : {"", "evolved/"}) {
      expect_worst(file, form);
      const Images robots = images(file, form + "robot");
      const auto absolute = file.read<float>(form + "absolute").values,
                 squared = file.read<float>(form + "squared").values;
      ASSERT_EQ(absolute.size(), robots.size());
      for (std::size_t i = 0; i < absolute.size(); ++i) {
        EXPECT_NEAR(absolute[i], difference(arm[i], robots[i], 1), 1 / 255.) << i;
        EXPECT_NEAR(squared[i], difference(arm[i], robots[i], 2), 2 / 255.) << i;
      }
    }
  }

  // Servos begin with digits that the transfer drew, and differ from those.
  void expect_dynamics(const std::string& robot) const {
    const Hdf5Reader file = of(robot + "_dynamics"), transfer = of(robot + "_transfer");
    const Images before = images(file, "image"), drawn = images(transfer, "robot");
    const auto id = file.read<std::int64_t>("id").values, all = transfer.read<std::int64_t>("id").values;
    ASSERT_EQ(id.size(), before.size());
    const double tolerance =
        nlohmann::json::parse(file.text_attribute("settings")).at("robot").at("off_plane_tolerance");
    for (std::size_t i = 0; i < id.size(); ++i)
      EXPECT_EQ(before[i], drawn.at(static_cast<std::size_t>(std::ranges::find(all, id[i]) - all.begin())));
    const auto travel = file.read<float>("wanted/travel").values,
               of_elites = file.read<float>("elites/travel").values;
    for (std::size_t i = 0; i < id.size(); ++i) EXPECT_LE(travel[i], of_elites[i]);
    const auto readable = file.read<std::uint8_t>("readable").values;
    for (const std::string player : {"elites", "wanted", "arm", "whole"}) {
      if (!file.has(player + "/image")) continue;
      const Images after = images(file, player + "/image");
      const auto absolute = file.read<float>(player + "/absolute").values;
      for (std::size_t i = 0; i < id.size(); ++i)
        EXPECT_NEAR(absolute[i], difference(before[i], after[i], 1), 1 / 255.) << player << i;
      if (player == "elites" || player == "wanted") continue;
      const auto off_board = file.read<std::uint8_t>(player + "/off_board").values,
                 beyond = file.read<std::uint8_t>(player + "/beyond_limit").values,
                 lost = file.read<std::uint8_t>(player + "/lost").values;
      const Array<float> torque = file.read<float>(player + "/torque"),
                         speed = file.read<float>(player + "/speed");
      const std::size_t joints = torque.shape.at(1);
      const auto rms = file.read<float>(player + "/rms").values,
                 most = file.read<float>(player + "/max").values,
                 off = file.read<float>(player + "/off_plane").values;
      for (std::size_t i = 0; i < id.size(); ++i) {
        EXPECT_LE(rms[i], most[i]);
        EXPECT_LE(lost[i], readable[i]);
        EXPECT_EQ(off_board[i], off[i] > tolerance);
        float greatest = 0;
        for (std::size_t k = i * joints; k < (i + 1) * joints; ++k)
          greatest = std::max({greatest, torque.values[k], speed.values[k]});
        EXPECT_EQ(beyond[i], greatest > 1);
        EXPECT_LT(off[i], 1) << "m of the robot";
      }
      EXPECT_EQ(file.has(player + "/margin"), player == "whole" && robot.starts_with("nao"));
      if (file.has(player + "/margin")) {
        const auto margin = file.read<float>(player + "/margin").values;
        const auto tips = file.read<std::uint8_t>(player + "/tips").values;
        for (std::size_t i = 0; i < id.size(); ++i) EXPECT_EQ(tips[i], margin[i] < 0);
        EXPECT_GT(*std::ranges::max_element(margin), 0) << "NAO stands";
        EXPECT_LT(*std::ranges::max_element(margin), 0.1f) << "m: half of its soles";
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
  // The digits that differ most, and no more places that lack something than there are.
  static void expect_worst(const Hdf5Reader& file, const std::string& form) {
    const auto id = file.read<std::int64_t>("id").values,
               worst = file.read<std::int64_t>(form + "worst/id").values;
    std::vector<float> absolute = file.read<float>(form + "absolute").values, of_worst;
    for (const std::int64_t digit : worst)
      of_worst.push_back(absolute.at(static_cast<std::size_t>(std::ranges::find(id, digit) - id.begin())));
    std::ranges::sort(absolute, std::greater<>());
    absolute.resize(std::min<std::size_t>(8, absolute.size()));
    EXPECT_EQ(of_worst, absolute);
    const auto counts = [&](const char* name) {
      return file.read<std::int32_t>(form + "worst/" + name).values;
    };
    const auto places = counts("places"), gap = counts("gap"), collision = counts("collision"),
               limit = counts("limit");
    for (std::size_t i = 0; i < worst.size(); ++i) {
      EXPECT_GT(places[i], 0);
      EXPECT_LE(gap[i] + collision[i] + limit[i], places[i]);
    }
  }

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
