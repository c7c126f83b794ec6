// Joints and genes.
#include "pipeline/hierarchy/joints.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "pipeline/core/random.h"

namespace hbr {
namespace {

class Limits final : public Robot {
 public:
  std::string name() const override { return "limits"; }
  const Eigen::VectorXd& lower() const override { return lower_; }
  const Eigen::VectorXd& upper() const override { return upper_; }
  std::string unit(Eigen::Index joint) const override { return joint == 1 ? "m" : "rad"; }
  void pens(Eigen::Index, const double*, Pen*) const override {}

 private:
  Eigen::VectorXd lower_ = Eigen::Vector3d(-2, 0.5, 1), upper_ = Eigen::Vector3d(3, 0.7, 1);
};

TEST(Joints, AreToldWithTheirRangesAndUnits) {
  const Coordinates joints = joint_coordinates(Limits());
  ASSERT_EQ(joints.size(), 3u);
  EXPECT_EQ(joints[0].unit, "rad");
  EXPECT_EQ(joints[1].unit, "m");
  EXPECT_EQ(joints[1].low, 0.5);
  EXPECT_EQ(joints[1].high, 0.7);
}

TEST(Joints, ComeBackFromTheirGenes) {
  const Limits robot;
  Rng rng(Seed(1));
  for (int i = 0; i < 100; ++i) {
    Eigen::Vector3d joints(rng.uniform(-2, 3), rng.uniform(0.5f, 0.7f), 1), again;
    const Eigen::VectorXf genes = encode_joints(robot, joints);
    EXPECT_GE(genes.minCoeff(), 0);
    EXPECT_LE(genes.maxCoeff(), 1);
    decode_joints(robot, genes.data(), again.data());
    EXPECT_LT((again - joints).norm(), 1e-6);
  }
  Eigen::Vector3d again;
  decode_joints(robot, encode_joints(robot, Eigen::Vector3d(-9, 9, 9)).data(), again.data());
  EXPECT_LT((again - Eigen::Vector3d(-2, 0.7, 1)).norm(), 1e-6);
}

// By all corners of the limits, where a convex cost has its most.
TEST(Joints, CostAtMostWhatTheirLimitsAllow) {
  for (const JointCost& cost : joint_costs())
    for (const int dof : {1, 2, 5, 8}) {
      double most = 0;
      for (int corner = 0; corner < 1 << dof; ++corner) {
        std::vector<double> joints;
        for (int j = 0; j < dof; ++j) joints.push_back(corner >> j & 1 ? 1.5 : -1.5);
        most = std::max(most, cost.of(joints.data(), dof));
      }
      const bool reached = dof % 2 == 0 || std::string(cost.name) == "few_joints";
      EXPECT_LE(most, cost.most(1.5, dof) + 1e-12) << cost.name << " " << dof;
      if (reached) {
        EXPECT_NEAR(most, cost.most(1.5, dof), 1e-12) << cost.name << " " << dof;
      }
    }
}

}  // namespace
}  // namespace hbr
