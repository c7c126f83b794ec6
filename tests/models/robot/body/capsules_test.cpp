#include "models/robot/body/capsules.h"

#include <gtest/gtest.h>

#include "tests/models/robot/description/urdf_text.h"

namespace hbr {
namespace {

// A link 0.2 m long and one at its end, both cubes of 0.5 m by their inertia.
RobotModel two_cubes(double mass) {
  const std::string cube = fmt::format(
      R"(<inertial><origin xyz="0.1 0 0"/><mass value="{0}"/><inertia ixx="{1}" iyy="{1}" izz="{1}" ixy="0"
         ixz="0" iyz="0"/></inertial>)",
      mass, mass / 12 * .5);
  const TestFolder folder;
  return load_urdf(folder.write(
      "cubes.urdf",
      robot(link("a", cube) + link("b", cube) +
            R"(<joint name="j" type="revolute"><parent link="a"/><child link="b"/><origin xyz="0.2 0 0"/>
               <axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>)")));
}

void expect(const std::vector<Capsule>& capsules, const Eigen::Vector3d& middle, double half, double radius) {
  ASSERT_EQ(capsules.size(), 1u);
  EXPECT_NEAR((capsules[0].middle - middle).norm(), 0, 1e-9);
  EXPECT_NEAR(capsules[0].half.norm(), half, 1e-9);
  EXPECT_NEAR(capsules[0].radius, radius, 1e-9);
}

TEST(Capsules, AreTheInertiasBoxUnlessThatIsLighterThanFoam) {
  const RobotModel heavy = two_cubes(10), light = two_cubes(.1);  // 80 and 0.8 kg / m^3
  expect(capsules_of(heavy, 0), {.1, 0, 0}, 0, .25);
  expect(capsules_of(heavy, 1), {.1, 0, 0}, 0, .25);
  expect(capsules_of(light, 0), {.1, 0, 0}, .1, .05);  // to the next link
  expect(capsules_of(light, 1), {.1, 0, 0}, 0, .25);   // nothing hangs on it
}

}  // namespace
}  // namespace hbr
