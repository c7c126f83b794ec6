// Rods that swing under gravity.
#pragma once

#include <gtest/gtest.h>

#include "models/robot/body/body.h"
#include "tests/models/robot/description/urdf_text.h"

namespace hbr {

inline constexpr double kG = 9.80665;

// A rod that turns about y: mass 2 kg, its centre 0.3 m below the joint, inertia 0.05 kg m^2 about it.
inline constexpr double kMass = 2, kArm = 0.3, kInertia = 0.05 + kMass * kArm * kArm;
inline std::string swinging(const std::string& name, const std::string& parent, const std::string& child,
                            const std::string& origin, const std::string& more = "") {
  return fmt::format(
      "<joint name=\"{}\" type=\"revolute\"><parent link=\"{}\"/><child link=\"{}\"/><origin xyz=\"{}\"/>"
      "<axis xyz=\"0 1 0\"/><limit lower=\"-3\" upper=\"3\" effort=\"9\" velocity=\"4\"/>{}</joint>\n",
      name, parent, child, origin, more);
}
inline const std::string kRod =
    R"(<inertial><origin xyz="0 0 -0.3"/><mass value="2"/>)"
    R"(<inertia ixx="0.05" iyy="0.05" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial>)";

class RodsTest : public testing::Test {
 protected:
  RobotModel load(const std::string& inside) const {
    return load_urdf(folder_.write("r.urdf", robot(inside)));
  }
  RobotModel pendulum() const {
    return load(link("base") + link("rod", kRod) + link("tip", "") + swinging("a", "base", "rod", "0 0 0") +
                "<joint name=\"end\" type=\"fixed\"><parent link=\"rod\"/><child link=\"tip\"/><origin "
                "xyz=\"0 0 -0.6\"/></joint>");
  }
  // Three rods, each at the end of the one before.
  RobotModel chain() const {
    return load(link("base") + link("one", kRod) + link("two", kRod) + link("three", kRod) +
                swinging("a", "base", "one", "0 0 0") + swinging("b", "one", "two", "0 0.1 -0.6") +
                swinging("c", "two", "three", "0 0 -0.6"));
  }
  // A heavy body with a light arm of two joints, all with strong servos.
  RobotModel body_and_arm() const {
    const auto rod = [](double mass, double inertia) {
      return fmt::format(
          "<inertial><origin xyz=\"0 0 -0.1\"/><mass value=\"{}\"/><inertia ixx=\"{}\" iyy=\"{}\" izz=\"{}\" "
          "ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial>",
          mass, inertia, inertia, inertia);
    };
    return load(
        link("base") + link("one", rod(5, 0.5)) + link("two", rod(0.3, 0.002)) +
        link("three", rod(0.2, 0.001)) + link("tip", "") + swinging("a", "base", "one", "0 0 0") +
        swinging("b", "one", "two", "0 0 -0.2") + swinging("c", "two", "three", "0 0 -0.2") +
        "<joint name=\"end\" type=\"fixed\"><parent link=\"three\"/><child link=\"tip\"/><origin xyz=\"0 "
        "0 -0.2\"/></joint>");
  }
  TestFolder folder_;
};

}  // namespace hbr
