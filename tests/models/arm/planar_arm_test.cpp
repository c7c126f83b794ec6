#include "models/arm/planar_arm.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <complex>
#include <numbers>

#include "pipeline/core/random.h"

namespace hbr {
namespace {

const std::vector<double> kLinks{.0875, .078, .072, .072, .071, .068, .068, .065};

TEST(PlanarArm, AgreesWithTheProductOfItsTransforms) {
  const PlanarArm arm(kLinks, std::numbers::pi / 2);
  ASSERT_EQ(arm.dof(), 8);
  Rng rng(Seed(20));
  constexpr int kPoses = 1000;
  std::vector<double> joints(kPoses * 8);
  for (int i = 0; i < kPoses * 8; ++i) joints[i] = arm.lower()[i % 8] * (2 * rng.uniform_double() - 1);
  std::vector<Pen> pens(kPoses);
  arm.pens(kPoses, joints.data(), pens.data());
  for (int i = 0; i < kPoses; ++i) {
    Eigen::Isometry2d pose = Eigen::Isometry2d::Identity();
    for (int j = 0; j < 8; ++j) {
      pose.rotate(Eigen::Rotation2Dd(joints[8 * i + j]));
      pose.translate(Eigen::Vector2d(kLinks[j], 0));
    }
    EXPECT_LT((pens[i].position - pose.translation()).norm(), 1e-14);
    EXPECT_EQ(pens[i].off_plane, 0);
  }
}

TEST(PlanarArm, StretchedItReachesTheSumOfItsLinks) {
  const PlanarArm arm(kLinks, std::numbers::pi / 2);
  const Eigen::VectorXd straight = Eigen::VectorXd::Zero(8);
  Pen pen;
  arm.pens(1, straight.data(), &pen);
  EXPECT_NEAR(pen.position.x(), 0.5815, 1e-15);
  EXPECT_EQ(pen.position.y(), 0);
}

}  // namespace
}  // namespace hbr
