#include "models/robot/plane/project_onto_plane.h"

#include <gtest/gtest.h>

#include <array>

#include "pipeline/core/random.h"
#include "pipeline/hierarchy/joints.h"
#include "pipeline/hierarchy/point_layer.h"
#include "tests/models/robot/body/chains.h"

namespace hbr {
namespace {

// Four links in the plane x = 0, one joint to spare and one more.
const RobotOnPlane& four() {
  static const RobotOnPlane robot("four", chain({{-2, 2}, {-2, 2}, {-1, 2}, {-2, .5}}, "1 0 0"), "tip",
                                  DrawingPlane::facing({0, 0, 0}, 0, 0, 1));
  return robot;
}

Eigen::VectorXd random_joints(Rng& rng) {
  Eigen::VectorXd joints(4);
  for (int k = 0; k < 4; ++k)
    joints[k] = four().lower()[k] + (four().upper()[k] - four().lower()[k]) * rng.uniform_double();
  return joints;
}
Eigen::Vector3d tip(const Eigen::VectorXd& joints) {
  return four().body().position(four().tip(), joints.data());
}

TEST(ProjectOntoPlane, JacobianIsTheDifferenceQuotient) {
  Rng rng(Seed(1).child("projected"));
  for (int i = 0; i < 20; ++i) {
    const Eigen::VectorXd q = random_joints(rng);
    const Eigen::Vector3d target(.1, rng.uniform(-3, 3), rng.uniform(-3, 3));
    Eigen::MatrixXd jacobian;
    projection_residuals(four(), target, q.data(), &jacobian);
    ASSERT_EQ(jacobian.rows(), 7);
    for (int k = 0; k < 4; ++k) {
      Eigen::VectorXd up = q, down = q;
      up[k] += 1e-5, down[k] -= 1e-5;
      const Eigen::VectorXd slope = (projection_residuals(four(), target, up.data()) -
                                     projection_residuals(four(), target, down.data())) /
                                    2e-5;
      EXPECT_LT((slope - jacobian.col(k)).norm(), 1e-3) << k;  // of 1e4 per radian
    }
  }
}

TEST(ProjectOntoPlane, ResidualsAreTheDistanceAndTheVariance) {
  Rng rng(Seed(2).child("projected"));
  const Eigen::VectorXd q = random_joints(rng);
  const Eigen::Vector3d target(0, 1, 1);
  const Eigen::VectorXd residuals = projection_residuals(four(), target, q.data());
  EXPECT_NEAR(residuals.head<3>().norm(), (tip(q) - target).norm() / 1e-4, 1e-6);
  EXPECT_NEAR(residuals.tail(4).squaredNorm(), joint_variance(q.data(), 4), 1e-12);
}

// The same bytes for any number of threads hang on it: each has memory of its own.
TEST(ProjectOntoPlane, ResidualsDoNotDependOnWhereTheJointsLie) {
  Rng rng(Seed(5).child("projected"));
  for (int i = 0; i < 100; ++i) {
    const Eigen::VectorXd q = random_joints(rng);
    const Eigen::VectorXd residuals = projection_residuals(four(), {0, 1, 1}, q.data());
    alignas(64) std::array<double, 12> memory;
    for (std::size_t offset = 0; offset < 8; ++offset) {
      std::copy(q.begin(), q.end(), memory.begin() + static_cast<std::ptrdiff_t>(offset));
      EXPECT_EQ(projection_residuals(four(), {0, 1, 1}, memory.data() + offset), residuals) << offset;
    }
  }
}

// Whatever the target, in reach or out of it.
TEST(ProjectOntoPlane, StaysInTheLimitsAndNeverGoesFarther) {
  Rng rng(Seed(3).child("projected"));
  for (int i = 0; i < 500; ++i) {
    const Eigen::VectorXd start = random_joints(rng);
    const Eigen::Vector3d target(rng.uniform(-.1f, .1f), rng.uniform(-5, 5), rng.uniform(-5, 5));
    const Eigen::VectorXd end = project_onto_plane(four(), target, start);
    EXPECT_TRUE((end.array() >= four().lower().array()).all());
    EXPECT_TRUE((end.array() <= four().upper().array()).all());
    EXPECT_LE((tip(end) - target).norm(), (tip(start) - target).norm());
    EXPECT_EQ(project_onto_plane(four(), tip(start), start), start);  // however unlike its joints are
  }
}

// A few millimetres away: it arrives, and the joints to spare are spent on being alike.
TEST(ProjectOntoPlane, ArrivesWithJointsMoreAlike) {
  Rng rng(Seed(4).child("projected"));
  int arrived = 0, alike = 0, tried = 0;
  for (int i = 0; i < 300; ++i) {
    const Eigen::VectorXd start = random_joints(rng);
    const Eigen::Vector3d target = tip(start) + Eigen::Vector3d(0, rng.uniform(-.003f, .003f), .002);
    if (target.norm() > 3.5 || target.norm() < .5) continue;
    const Eigen::VectorXd end = project_onto_plane(four(), target, start);
    ++tried;
    arrived += (tip(end) - target).norm() < 1e-5;
    alike += joint_variance(end.data(), 4) <= joint_variance(start.data(), 4) + 1e-3;
  }
  EXPECT_GT(tried, 100);
  EXPECT_GT(arrived, .95 * tried);
  EXPECT_GT(alike, .95 * tried);
}

}  // namespace
}  // namespace hbr
