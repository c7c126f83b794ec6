// Joints and genes.
#include "pipeline/hierarchy/joints.h"

#include <gtest/gtest.h>

#include "pipeline/core/random.h"

namespace hbr {
namespace {

class Limits final : public Robot {
 public:
  std::string name() const override { return "limits"; }
  const Eigen::VectorXd& lower() const override { return lower_; }
  const Eigen::VectorXd& upper() const override { return upper_; }
  void pens(Eigen::Index, const double*, Pen*) const override {}

 private:
  Eigen::VectorXd lower_ = Eigen::Vector3d(-2, 0.5, 1), upper_ = Eigen::Vector3d(3, 0.7, 1);
};

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

}  // namespace
}  // namespace hbr
