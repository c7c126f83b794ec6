// A robot in three dimensions, read as FORMAT.md says and posed plainly: the pen is where it is stored.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/artifact/unit_columns.h"
#include "tests/support/forward_kinematics.h"

namespace hbr {

class ShapeOfRun {
 public:
  ShapeOfRun(const std::filesystem::path& out, const std::string& robot)
      : file_(out / (robot + "_shape.h5")), shape_(file_) {}

  // Every posture of every digit: on the board, and there where `pen` says, m.
  void expect_pens(const std::vector<std::vector<double>>& joints, const std::vector<Eigen::Vector2d>& pens,
                   double off_board) const {
    const Eigen::Vector3d origin = vector("plane/origin"), u = vector("plane/u"), v = vector("plane/v"),
                          place = vector("pen/place");
    const double scale = file_.number_attribute("plane_scale");
    const auto part = static_cast<std::size_t>(file_.number_attribute("pen_part"));
    ASSERT_EQ(joints.size(), pens.size());
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const ShapeArtifact::Frame frame = shape_.frames(joints[i]).at(part);
      const Eigen::Vector3d away = frame.turn * place + frame.place - origin;
      EXPECT_NEAR(away.dot(u) / scale, pens[i].x(), 1e-5) << i;
      EXPECT_NEAR(away.dot(v) / scale, pens[i].y(), 1e-5) << i;
      EXPECT_LE(std::abs(away.dot(u.cross(v))), off_board) << i;
    }
  }

  // Triangles name vertices of their own piece, and there are no more of them than were asked for.
  void expect_pieces() const {
    const auto vertices = file_.read<std::int32_t>("piece/vertices").values,
               triangles = file_.read<std::int32_t>("piece/triangles").values,
               part = file_.read<std::int32_t>("piece/part").values,
               corner = file_.read<std::int32_t>("triangle/vertex").values;
    ASSERT_FALSE(part.empty());
    EXPECT_TRUE(std::ranges::is_sorted(part));
    EXPECT_LT(part.back(), static_cast<int>(shape_.parent.size()));
    std::size_t at = 0, vertex = 0;
    for (std::size_t i = 0; i < part.size(); ++i) {
      for (std::int32_t k = 0; k < 3 * triangles[i]; ++k, ++at) {
        ASSERT_GE(corner.at(at), 0);
        ASSERT_LT(corner[at], vertices[i]);
      }
      vertex += static_cast<std::size_t>(vertices[i]);
    }
    EXPECT_EQ(at, corner.size());
    EXPECT_EQ(3 * vertex, file_.read<float>("vertex/position").values.size());
    EXPECT_LE(static_cast<double>(at), 3 * file_.number_attribute("settings.shape.triangles"));
  }

 private:
  Eigen::Vector3d vector(const std::string& name) const {
    const auto values = file_.read<double>(name).values;
    return {values.at(0), values.at(1), values.at(2)};
  }

  Hdf5Reader file_;
  ShapeArtifact shape_;
};

// Of a robot, along its ways; and the ways are those of layer 4's digits.
inline void expect_robot_shape(const std::filesystem::path& out, const std::string& robot, double tolerance) {
  SCOPED_TRACE(robot);
  const ShapeOfRun shape(out, robot);
  shape.expect_pieces();
  const Hdf5Reader ways(out / (robot + "_ways/00.h5")), layer4(out / "layer4/00.h5");
  EXPECT_EQ(ways.read<std::int64_t>("id").values, layer4.read<std::int64_t>("id").values);
  const auto joints = ways.read<float>("joints"), pen = ways.read<float>("pen");
  const auto points = ways.read<std::int32_t>("points").values, way = ways.read<std::int32_t>("way").values;
  const auto smooth = ways.read<std::uint8_t>("smooth").values;
  EXPECT_GT(std::ranges::count(smooth, 1), 0);
  EXPECT_LE(std::ranges::count(smooth, 1), 10);
  std::int64_t sum = 0;
  for (const std::int32_t count : points) sum += count;
  ASSERT_EQ(sum, static_cast<std::int64_t>(way.size()));
  std::vector<bool> used(joints.shape.at(0));
  for (const std::int32_t row : way) used.at(static_cast<std::size_t>(row)) = true;
  EXPECT_TRUE(std::ranges::all_of(used, [](bool is) { return is; }));
  std::vector<std::vector<double>> postures;
  std::vector<Eigen::Vector2d> pens;
  const std::size_t dof = joints.shape.at(1);
  for (std::size_t i = 0; i < used.size(); ++i) {
    postures.emplace_back(joints.values.begin() + static_cast<std::ptrdiff_t>(i * dof),
                          joints.values.begin() + static_cast<std::ptrdiff_t>((i + 1) * dof));
    pens.emplace_back(pen.values[2 * i], pen.values[2 * i + 1]);
  }
  shape.expect_pens(postures, pens, tolerance * 1.001);
}

// Of the arm, for every elite of layer 1, through which all its digits lead.
inline void expect_arm_shape(const std::filesystem::path& out) {
  SCOPED_TRACE("arm");
  const ShapeOfRun shape(out, "arm");
  shape.expect_pieces();
  const std::filesystem::path layer1 = out / "layer1/00.h5";
  const auto real = [&](const std::string& name) {
    const auto array = Hdf5Reader(layer1).read<float>(name);
    const UnitColumns columns = read_unit_columns(layer1, name);
    std::vector<std::vector<double>> rows(array.shape.at(0));
    for (std::size_t i = 0; i < array.values.size(); ++i) {
      const std::size_t k = i % columns.from.size();
      const double share = (array.values[i] - columns.low) / (columns.high - columns.low);
      rows[i / columns.from.size()].push_back(columns.from[k] + share * (columns.to[k] - columns.from[k]));
    }
    return rows;
  };
  std::vector<Eigen::Vector2d> pens;
  for (const std::vector<double>& place : real("measures")) pens.emplace_back(place.at(0), place.at(1));
  shape.expect_pens(real("solution"), pens, 1e-9);
}

}  // namespace hbr
