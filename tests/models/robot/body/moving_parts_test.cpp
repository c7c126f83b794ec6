#include "models/robot/body/moving_parts.h"

#include <gtest/gtest.h>

#include <cmath>

#include "models/robot/body/body.h"
#include "pipeline/core/random.h"

namespace hbr {
namespace {

// Every link of the body, posed part by part, is where Simbody has it.
void expect_links(const Body& body, std::uint64_t seed) {
  const MovingParts moving = body.moving_parts();
  ASSERT_EQ(moving.places.size(), body.model().links.size());
  Rng rng{Seed(seed)};
  for (int i = 0; i < 50; ++i) {
    Eigen::VectorXd q(body.dof());
    for (Eigen::Index k = 0; k < q.size(); ++k)
      q[k] = std::lerp(body.lower()[k], body.upper()[k], rng.uniform_double());
    std::vector<Eigen::Isometry3d> frames;
    for (const MovingPart& part : moving.parts) {
      if (part.parent < 0) {
        frames.push_back(Eigen::Isometry3d::Identity());
        continue;
      }
      ASSERT_LT(part.parent, static_cast<int>(frames.size()));
      const double position = part.multiplier * q[part.coordinate] + part.offset;
      Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
      if (part.slides)
        motion.translate(Eigen::Vector3d(position * part.axis));
      else
        motion.rotate(Eigen::AngleAxisd(position, part.axis));
      frames.push_back(frames[static_cast<std::size_t>(part.parent)] * part.origin * motion);
    }
    const std::vector<Eigen::Isometry3d> poses = body.link_poses(q);
    for (std::size_t link = 0; link < poses.size(); ++link) {
      const Parts::Place& place = moving.places[link];
      EXPECT_TRUE((frames[static_cast<std::size_t>(place.part)] * place.pose).isApprox(poses[link], 1e-9))
          << body.model().links[link].name;
    }
  }
}

TEST(MovingParts, PoseNaosLinksAsSimbodyDoes) {
  const RobotModel nao = load_urdf(HBR_SOURCE_DIR "/models/nao/nao.urdf");
  expect_links(Body(nao, nao.independent_joints()), 1);
  expect_links(Body(nao, {"RShoulderPitch", "RElbowRoll"}, {{"RShoulderRoll", -0.4}, {"HeadYaw", 0.3}}), 2);
}

TEST(MovingParts, PoseAnIndustrialArm) {
  const RobotModel arm = load_urdf(HBR_SOURCE_DIR "/models/industrial/six_joint_arm.urdf");
  expect_links(Body(arm, arm.independent_joints()), 3);
}

TEST(MovingParts, SlideAndFollow) {
  RobotModel model;
  model.name = "slides";
  for (int i = 0; i < 4; ++i) model.links.push_back({"l" + std::to_string(i), {}, {}, i - 1, false});
  for (int i = 0; i < 3; ++i) {
    Joint joint{};
    joint.name = "j" + std::to_string(i);
    joint.kind = i == 1 ? Joint::Kind::revolute : Joint::Kind::prismatic;
    joint.parent = i;
    joint.child = i + 1;
    joint.origin = Eigen::Isometry3d(Eigen::AngleAxisd(0.3 + i, Eigen::Vector3d(1, 2, 3).normalized()));
    joint.origin.translation() = Eigen::Vector3d(0.1 * i, 0.2, -0.3);
    joint.axis = Eigen::Vector3d(i, 1, 2 - i).normalized();
    joint.lower = -1;
    joint.upper = 1;
    if (i == 2) joint.mimic = 0, joint.multiplier = -0.5, joint.offset = 0.07;
    model.joints.push_back(joint);
  }
  expect_links(Body(model, {"j1", "j0"}), 4);
}

}  // namespace
}  // namespace hbr
