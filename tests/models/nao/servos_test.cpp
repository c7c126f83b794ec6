// NAO under gravity: what its ankle bears, and a stroke drawn by its arm and by its whole body.
#include "models/robot/body/servos.h"
#include "tests/models/nao/right_arm.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hbr {
namespace {

const std::map<std::string, double> kRest{{"LHipPitch", -0.3},     {"LKneePitch", 0.6}, {"LAnklePitch", -0.3},
                                          {"RHipPitch", -0.3},     {"RKneePitch", 0.6}, {"RAnklePitch", -0.3},
                                          {"LShoulderPitch", 1.45}};

class NaoServos : public testing::Test {
 protected:
  std::vector<int> drawing(const Body& body) const {
    std::vector<int> joints;
    for (const std::string& name : kRightArm)
      joints.push_back(static_cast<int>(std::ranges::find(body.moving(), name) - body.moving().begin()));
    return joints;
  }
  RobotModel model_ = load_urdf(HBR_SOURCE_DIR "/models/nao/nao.urdf");
  const std::vector<std::string> joints_ = joints_with_inertia(model_, kRest, 1e-6);
};

TEST_F(NaoServos, FingersAreTheLightest) {
  EXPECT_EQ(joints_.size(), 23u);
  for (const char* finger : {"LHand", "RHand"})
    EXPECT_EQ(std::ranges::find(joints_, finger), joints_.end()) << finger;
}

// The torque of the first joint above the ground is the moment of the weight of all that it carries.
TEST_F(NaoServos, TheAnkleBearsTheBody) {
  const Body body(model_, joints_, kRest, "l_ankle");
  const Eigen::VectorXd posture = body.posture(kRest);
  Equations equations;
  body.equations(posture, Eigen::VectorXd::Zero(body.dof()), kGravity, equations);

  const auto poses = body.link_poses(posture);
  const Joint& ankle = model_.joints[static_cast<std::size_t>(model_.joint("LAnkleRoll"))];
  const Eigen::Isometry3d& foot = poses[static_cast<std::size_t>(ankle.child)];
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < model_.links.size(); ++i) {
    if (!model_.links[i].inertial || static_cast<int>(i) == ankle.child) continue;
    const Inertial& in = *model_.links[i].inertial;
    moment += (poses[i] * in.centre - foot.translation()).cross(in.mass * kGravity);
  }
  const auto at = std::ranges::find(body.moving(), "LAnkleRoll") - body.moving().begin();
  EXPECT_NEAR(equations.bias[at], moment.dot(foot.linear() * ankle.axis), 1e-9);
  EXPECT_GT(std::abs(equations.bias[at]), 1);
}

TEST_F(NaoServos, FollowAStroke) {
  std::vector<double> joints, times;
  for (int i = 0; i <= 50; ++i) {
    const double t = 0.02 * i;
    times.push_back(t);
    for (const double middle : {0.4, -0.3, 1.2, 0.7})
      joints.push_back(middle + 0.1 * std::sin(6 * t + middle));
  }
  const JointPath path(joints, times, 0.05);
  const ServoSettings servos{0.002, 5, 5, 3};
  const auto worst = [&](const Body& body) {
    const Replay run =
        replay(body, model_.link("r_gripper"), path, drawing(body), body.posture(kRest), servos);
    EXPECT_LT(run.torque.maxCoeff(), 1);
    double error = 0;
    for (std::size_t i = 0; i < run.tip.size(); ++i)
      error = std::max(error, (run.tip[i] - run.wanted[i]).norm());
    return error;
  };
  const double arm = worst(Body(model_, kRightArm, kRest)),
               whole = worst(Body(model_, joints_, kRest, "l_ankle"));
  EXPECT_LT(arm, 0.5e-3);
  EXPECT_GT(whole, arm);  // it gives way
  EXPECT_LT(whole, 0.01);
  // With its torso held the rest of the body does not feel the arm.
  const double seated = worst(Body(model_, joints_, kRest));
  EXPECT_LT(seated, whole / 2);
}

}  // namespace
}  // namespace hbr
