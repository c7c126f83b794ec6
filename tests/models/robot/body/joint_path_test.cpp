#include "models/robot/body/joint_path.h"

#include <gmock/gmock.h>

namespace hbr {
namespace {

TEST(JointPath, BeginsAndEndsAtRestWithinItsWayPoints) {
  const std::vector<double> joints{0.1, 1, 0.5, -1, -0.3, 0.2}, times{0, 0.32, 0.5};
  const JointPath path(joints, times, 0.05);
  EXPECT_GE(path.duration(), 0.5);
  EXPECT_LE(path.duration(), 0.5 + 4 * 0.05);
  const auto begin = path.at(0), end = path.at(path.duration());
  EXPECT_LT((begin.position - Eigen::Vector2d(0.1, 1)).norm(), 1e-15);
  EXPECT_LT((end.position - Eigen::Vector2d(-0.3, 0.2)).norm(), 1e-15);
  for (const auto& point : {begin, end, path.at(-1), path.at(9)})
    EXPECT_LT(point.velocity.norm() + point.acceleration.norm(), 1e-12);
  constexpr double h = 1e-5;
  for (double t = h; t < path.duration() - h; t += 0.0137) {
    const auto point = path.at(t), before = path.at(t - h), after = path.at(t + h);
    EXPECT_LT(((after.position - before.position) / (2 * h) - point.velocity).norm(), 1e-6);
    EXPECT_LT(((after.velocity - before.velocity) / (2 * h) - point.acceleration).norm(), 0.05);
    EXPECT_LE(point.position[0], 0.5);
    EXPECT_GE(point.position[0], -0.3);
  }
}

TEST(JointPath, GoesStraightWhereItsWayIsStraight) {
  const JointPath path({0, 2}, {0, 2}, 0.1);
  for (double t = 0.5; t < 1.5; t += 0.01) {
    EXPECT_NEAR(path.at(t).velocity[0], 1, 1e-12);
    EXPECT_NEAR(path.at(t + 0.1).position[0] - path.at(t).position[0], 0.1, 1e-12);
  }
}

TEST(JointPath, KeepsPaceOfPenAndJoints) {
  const std::vector<float> pen{0, 0, 0.3f, 0.4f, 0.3f, 0.4f};
  EXPECT_THAT(times_at_pace(pen, {0, 0, 0.1, 0, 0.1, 3}, 0.25, 2),
              testing::Pointwise(testing::DoubleNear(1e-7), {0., 2., 3.5}));
}

}  // namespace
}  // namespace hbr
