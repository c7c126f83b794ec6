#include "models/robot/plane/planar_body.h"

#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/core/random.h"

namespace hbr {
namespace {

TEST(PlanarBody, PutsThePenWhereTheClosedFormDoes) {
  const std::vector<double> links{0.1, 0.07, 0.2, 0.05};
  const RobotOnPlane arm = planar_body(links, 1.5);
  ASSERT_EQ(arm.dof(), 4);
  EXPECT_EQ(arm.lower(), Eigen::VectorXd::Constant(4, -1.5));
  Rng rng(Seed(1));
  for (int i = 0; i < 100; ++i) {
    double q[4], x = 0, y = 0, angle = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      q[k] = 1.5 * (2 * rng.uniform_double() - 1);
      angle += q[k];
      x += links[k] * std::cos(angle);
      y += links[k] * std::sin(angle);
    }
    Pen pen;
    arm.pens(1, q, &pen);
    EXPECT_LT((pen.position - Eigen::Vector2d(x, y)).norm(), 1e-12);
    EXPECT_NEAR(pen.off_plane, 0, 1e-12);
  }
}

// What is seen of it is on the side from which one looks, and nothing is behind the board.
TEST(PlanarBody, StandsBeforeItsBoard) {
  const RobotOnPlane arm = planar_body({0.1, 0.1}, 1.5);
  EXPECT_EQ(arm.plane().normal(), -Eigen::Vector3d::UnitY());
  double before = 1;
  for (const Link& link : arm.body().model().links)
    for (const Visual& visual : link.visuals) {
      const double off = -visual.pose.translation().y();
      EXPECT_GT(off, 0) << link.name;
      if (&visual != &link.visuals.front()) continue;
      EXPECT_LT(off, before) << link.name;
      before = off;
    }
}

}  // namespace
}  // namespace hbr
