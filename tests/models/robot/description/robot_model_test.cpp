// What of a URDF is taken, as it is meant.
#include "models/robot/description/robot_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/core/check.h"
#include "tests/models/robot/description/urdf_text.h"

namespace hbr {
namespace {

TEST(RobotModel, NoMassAndNoInertiaIsAFrame) {
  const TestFolder folder;
  const RobotModel model = load_urdf(
      folder.write("a.urdf", robot(link("a") + link("b", inertial("0.0", R"(ixx="0" iyy="0" izz="0")")) +
                                   joint("j", "a", "b", "fixed"))));
  EXPECT_TRUE(model.links[0].inertial);
  EXPECT_FALSE(model.links[1].inertial);
}

TEST(RobotModel, TurnsInertiasIntoTheLinksAxes) {
  const TestFolder folder;
  const RobotModel model = load_urdf(folder.write(
      "a.urdf",
      robot(link("a", R"(<inertial><origin xyz="1 2 3" rpy="0 0 1.5707963267948966"/><mass value="2"/>)"
                      R"(<inertia ixx="1" iyy="2" izz="2.5" ixy="0.1" ixz="0.2" iyz="0.3"/></inertial>)"))));
  Eigen::Matrix3d expected;  // x became y, y became -x
  expected << 2, -.1, -.3, -.1, 1, .2, -.3, .2, 2.5;
  EXPECT_LT((model.links[0].inertial->inertia - expected).norm(), 1e-12);
  EXPECT_EQ(model.links[0].inertial->centre, Eigen::Vector3d(1, 2, 3));
}

TEST(RobotModel, KeepsTheOrderOfTheFile) {
  const TestFolder folder;
  const RobotModel model =
      load_urdf(folder.write("a.urdf", robot(link("z") + link("y") + link("x") + joint("q", "z", "y") +
                                             joint("p", "z", "x", "fixed"))));
  EXPECT_EQ(model.links[0].name, "z");
  EXPECT_EQ(model.links[1].name, "y");
  EXPECT_EQ(model.joints[1].name, "p");
  EXPECT_THAT(model.independent_joints(), testing::ElementsAre("q"));
  EXPECT_EQ(model.link("x"), 2);
  EXPECT_THROW(model.link("hand"), InputError);
  EXPECT_THROW(model.joint("hand"), InputError);
}

}  // namespace
}  // namespace hbr
