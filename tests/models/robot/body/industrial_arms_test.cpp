// The industrial arms of our own: what their URDFs' heads say of them, and that their masses are those of
// their shapes.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "models/robot/body/body.h"
#include "models/robot/looks/mesh_file.h"
#include "pipeline/core/random.h"

namespace hbr {
namespace {

RobotModel six_joint_arm() { return load_urdf(HBR_SOURCE_DIR "/models/industrial/six_joint_arm.urdf"); }

RobotModel seven_joint_arm() { return load_urdf(HBR_SOURCE_DIR "/models/industrial/seven_joint_arm.urdf"); }

TEST(SixJointArm, AllSixJointsMoveThePen) {
  const RobotModel model = six_joint_arm();
  const Body body(model, model.independent_joints());
  ASSERT_EQ(body.dof(), 6);
  EXPECT_EQ(body.moves(model.link("pen")), std::vector<bool>(6, true));
  EXPECT_NEAR(body.mass(), 67.5, 1e-12);
}

// From its shoulder the pen goes as far as the two arms and the hand are long, and not farther.
TEST(SixJointArm, ReachesAMetre) {
  const RobotModel model = six_joint_arm();
  const Body body(model, model.independent_joints());
  const int pen = model.link("pen");
  const Eigen::Vector3d shoulder(0.05, 0, 0.655);
  // The upper arm forward and all the rest in line with it.
  const double forward[] = {0, std::numbers::pi / 2, -std::numbers::pi / 2, 0, 0, 0};
  const Eigen::Vector3d straight = body.position(pen, forward) - shoulder;
  EXPECT_LT((straight - Eigen::Vector3d(0.42 + 0.15 + 0.26 + 0.095 + 0.1, 0, 0.02 - 0.04)).norm(), 1e-12);
  Rng rng(Seed(1).child("reach"));
  double farthest = 0;
  for (int i = 0; i < 20000; ++i) {
    double q[6];
    q[0] = 0;
    for (int k = 1; k < 6; ++k)
      q[k] = body.lower()[k] + (body.upper()[k] - body.lower()[k]) * rng.uniform_double();
    farthest = std::max(farthest, (body.position(pen, q) - shoulder).norm());
  }
  EXPECT_GT(farthest, 0.95);
  EXPECT_LT(farthest, 0.42 + std::hypot(0.15, 0.02) + 0.26 + 0.095 + std::hypot(0.1, 0.04) + 1e-9);
}

// Each link's centre of mass lies among its shapes, and its inertia is that of a body no larger than they.
void expect_masses_that_fit(const RobotModel& model) {
  const auto meshes = link_meshes(model, "", 1);
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    if (!model.links[i].inertial) continue;
    SCOPED_TRACE(model.links[i].name);
    Eigen::AlignedBox3d box;
    for (const Mesh& mesh : meshes[i])
      for (const Eigen::Vector3f& vertex : mesh.vertices) box.extend(vertex.cast<double>());
    const Inertial& in = *model.links[i].inertial;
    EXPECT_TRUE(box.contains(in.centre));
    const double density = in.mass / box.volume();  // kg / m^3, of the box around it
    EXPECT_GT(density, 300);
    EXPECT_LT(density, 7800);
    const Eigen::Vector3d size = box.sizes();
    for (int k = 0; k < 3; ++k) {
      const double across = size.squaredNorm() - size[k] * size[k];
      EXPECT_GT(in.inertia(k, k), in.mass * across / 40);
      EXPECT_LT(in.inertia(k, k), in.mass * across / 10);
    }
  }
}

TEST(SixJointArm, MassesFitTheShapes) { expect_masses_that_fit(six_joint_arm()); }

TEST(SevenJointArm, MassesFitTheShapes) { expect_masses_that_fit(seven_joint_arm()); }

TEST(SevenJointArm, AllSevenJointsMoveThePen) {
  const RobotModel model = seven_joint_arm();
  const Body body(model, model.independent_joints());
  ASSERT_EQ(body.dof(), 7);
  EXPECT_EQ(body.moves(model.link("pen")), std::vector<bool>(7, true));
  EXPECT_NEAR(body.mass(), 24.5, 1e-12);
  const Eigen::VectorXd upright = Eigen::VectorXd::Zero(7);
  EXPECT_LT((body.position(model.link("pen"), upright.data()) - Eigen::Vector3d(0.04, 0, 0.16 + 0.16 + 0.97))
                .norm(),
            1e-12);
}

}  // namespace
}  // namespace hbr
