// Masses of links that move as one, against clouds of point masses.
#include "models/robot/description/parts.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "pipeline/core/random.h"

namespace hbr {
namespace {

struct Point {
  Eigen::Vector3d at;
  double mass;
};

Eigen::Matrix3d inertia_about(const Eigen::Vector3d& centre, const std::vector<Point>& points) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Point& p : points) {
    const Eigen::Vector3d r = p.at - centre;
    sum += p.mass * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
  }
  return sum;
}

Inertial inertial_of(const std::vector<Point>& points) {
  Inertial in{0, {0, 0, 0}, {}};
  for (const Point& p : points) in.mass += p.mass;
  for (const Point& p : points) in.centre += p.mass * p.at / in.mass;
  in.inertia = inertia_about(in.centre, points);
  return in;
}

TEST(Parts, FixedAndLockedLinksAddUp) {
  // root - moving - fixed - locked: the last three move as one.
  Rng rng(Seed(1).child("parts"));
  const auto point = [&] {
    return Eigen::Vector3d(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1));
  };
  RobotModel model{"test", "test.urdf", {}, {}, {}};
  std::vector<std::vector<Point>> clouds(4);
  const Joint::Kind kinds[] = {Joint::Kind::revolute, Joint::Kind::fixed, Joint::Kind::prismatic};
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < 6; ++k) clouds[i].push_back({point(), rng.uniform(.1f, 2.f)});
    model.links.push_back({fmt::format("l{}", i), inertial_of(clouds[i]), {}, i - 1});
    if (i == 0) continue;
    Eigen::Isometry3d origin{Eigen::Translation3d(point())};
    origin.rotate(Eigen::AngleAxisd(rng.uniform(-3, 3), point().normalized()));
    model.joints.push_back(
        {fmt::format("j{}", i), kinds[i - 1], i - 1, i, origin, point().normalized(), -1, 1, 0, 0});
  }
  const Parts parts = join_parts(model, {"j1"}, {{"j3", 0.4}});
  ASSERT_EQ(parts.parts.size(), 2u);

  const Eigen::Isometry3d second = model.joints[1].origin;
  const Eigen::Isometry3d third =
      second * model.joints[2].origin * Eigen::Translation3d(0.4 * model.joints[2].axis);
  std::vector<Point> together = clouds[1];
  for (const Point& p : clouds[2]) together.push_back({second * p.at, p.mass});
  for (const Point& p : clouds[3]) together.push_back({third * p.at, p.mass});
  const Inertial expected = inertial_of(together);
  const Part& part = parts.parts[1];
  EXPECT_NEAR(part.mass, expected.mass, 1e-12);
  EXPECT_LT((part.centre - expected.centre).norm(), 1e-12);
  EXPECT_LT((part.inertia_origin - inertia_about({0, 0, 0}, together)).norm(), 1e-11);
  EXPECT_LT((parts.places[3].pose.matrix() - third.matrix()).norm(), 1e-12);
}

}  // namespace
}  // namespace hbr
