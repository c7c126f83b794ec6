#include "models/arm/planar_arm.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <bit>
#include <cmath>
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

// Random configurations with edges among them: whole and half turns, zeros of both signs, next to nothing.
std::vector<double> configurations(Eigen::Index n, Eigen::Index dof, double limit, Rng& rng) {
  constexpr double kPi = std::numbers::pi;
  const double edges[] = {0.0, -0.0, kPi / 2, -kPi / 2, kPi, -kPi, limit, -limit, 1e-300, 0x1p-60, -1e-9};
  std::vector<double> joints(n * dof);
  for (double& q : joints)
    q = rng.below(4) == 0 ? edges[rng.below(std::size(edges))] : limit * (2 * rng.uniform_double() - 1);
  return joints;
}

Eigen::Vector2d exact_tip(const std::vector<double>& links, const double* joints) {
  long double angle = 0, x = 0, y = 0;
  for (std::size_t j = 0; j < links.size(); ++j) {
    angle += joints[j];
    x += links[j] * std::cos(angle);
    y += links[j] * std::sin(angle);
  }
  return {static_cast<double>(x), static_cast<double>(y)};
}

TEST(PlanarArm, IsExactForAnyNumberOfConfigurations) {
  const PlanarArm arm(kLinks, 3.2);
  Rng rng(Seed(21));
  for (Eigen::Index n = 0; n <= 100; ++n) {
    const std::vector<double> joints = configurations(n, 8, 3.2, rng);
    std::vector<Pen> pens(n + 1, Pen{{7, 7}, 7});
    arm.pens(n, joints.data(), pens.data());
    for (Eigen::Index i = 0; i < n; ++i) {
      EXPECT_LT((pens[i].position - exact_tip(kLinks, &joints[8 * i])).norm(), 1e-14);
      EXPECT_EQ(pens[i].off_plane, 0);
    }
    EXPECT_EQ(pens[n].off_plane, 7) << "wrote beyond the last of " << n;
  }
}

TEST(PlanarArm, ManyLinksTurnManyTimes) {
  for (const std::size_t count : {1, 3, 100, 1000}) {
    const std::vector<double> links(count, 1.0 / static_cast<double>(count));
    const PlanarArm arm(links, 3.2);
    Rng rng(Seed(22).child(count));
    std::vector<double> joints = configurations(9, arm.dof(), 3.2, rng);
    std::fill_n(joints.begin(), count, 3.2);  // the first one curls up: the sum grows to count x 3.2
    std::vector<Pen> pens(9);
    arm.pens(9, joints.data(), pens.data());
    for (int i = 0; i < 9; ++i)
      EXPECT_LT((pens[i].position - exact_tip(links, &joints[i * count])).norm(), 1e-12) << count << " links";
  }
}

TEST(PlanarArm, AngleByAngle) {
  const PlanarArm arm({1}, 3.2);
  std::vector<double> angles;
  for (int i = -20000; i <= 20000; ++i) angles.push_back(i * 1e-3);
  for (int quarter = -40; quarter <= 40; ++quarter)  // both sides of where one half turn becomes the next
    for (const double beside : {-1e-15, -1e-9, 0.0, 1e-9, 1e-15})
      angles.push_back(quarter * std::numbers::pi / 2 + beside);
  std::vector<Pen> pens(angles.size());
  arm.pens(static_cast<Eigen::Index>(angles.size()), angles.data(), pens.data());
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const double tolerance = 1e-15 + 2.3e-16 * std::abs(angles[i]);
    EXPECT_NEAR(pens[i].position.x(), std::cos(angles[i]), tolerance) << angles[i];
    EXPECT_NEAR(pens[i].position.y(), std::sin(angles[i]), tolerance) << angles[i];
  }
}

// The same on every processor and for every width of its vectors; a new number means new bits everywhere.
TEST(PlanarArm, HasItsSignature) {
  const PlanarArm arm(kLinks, std::numbers::pi / 2);
  Rng rng(Seed(24));
  const std::vector<double> joints = configurations(1003, 8, std::numbers::pi / 2, rng);
  std::vector<Pen> pens(1003);
  arm.pens(1003, joints.data(), pens.data());
  std::uint64_t signature = 0;
  for (const Pen& pen : pens)
    for (const double coordinate : pen.position)
      signature = signature * 0x9e3779b97f4a7c15 + std::bit_cast<std::uint64_t>(coordinate);
  EXPECT_EQ(signature, 11221565922642978727u);
}

TEST(PlanarArm, APenDoesNotDependOnItsNeighbours) {
  const PlanarArm arm(kLinks, std::numbers::pi / 2);
  Rng rng(Seed(23));
  constexpr int kPoses = 61;
  const std::vector<double> joints = configurations(kPoses, 8, std::numbers::pi / 2, rng);
  std::vector<Pen> together(kPoses), part(kPoses);
  arm.pens(kPoses, joints.data(), together.data());
  for (int begin = 0; begin < kPoses; ++begin)
    for (const int n : {1, 5, 8, 20}) {
      if (begin + n > kPoses) continue;
      arm.pens(n, &joints[8 * begin], part.data());
      for (int i = 0; i < n; ++i) ASSERT_EQ(part[i].position, together[begin + i].position);
    }
}

}  // namespace
}  // namespace hbr
