// NAO's body: the closed form of its right hand, the table of masses, 25 independent joints.
#include "models/robot/body/body.h"

#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <cmath>
#include <sstream>

#include "pipeline/core/random.h"
#include "tests/models/nao/right_arm.h"

namespace hbr {
namespace {

// The right hand in the torso's frame, solved by hand from the lengths of the arm.
Eigen::Vector3d hand(const double* q) {
  const double h = .01231, l1 = .105, l2 = .1137, o = .015;
  const double c1 = std::cos(q[0]), s1 = std::sin(q[0]), c2 = std::cos(q[1]), s2 = std::sin(q[1]);
  const double c3 = std::cos(q[2]), s3 = std::sin(q[2]), c4 = std::cos(q[3]), s4 = std::sin(q[3]);
  const double x = l2 * c4 + l1, y = c3 * l2 * s4 + s3 * h - o, z = s3 * l2 * s4 - c3 * h;
  const double x2 = c2 * x - s2 * y, y2 = s2 * x + c2 * y;
  return {c1 * x2 + s1 * z, y2 - .098, -s1 * x2 + c1 * z + .1};
}

TEST(Nao, HandFollowsTheClosedForm) {
  const Body body(load_urdf(kUrdf), kRightArm);
  const int tip = body.model().link("r_gripper"), n = 100000;
  std::vector<double> joints(4 * n);
  Rng rng(Seed(1).child("nao"));
  for (int i = 0; i < 4 * n; ++i)
    joints[i] = body.lower()[i % 4] + (body.upper()[i % 4] - body.lower()[i % 4]) * rng.uniform_double();
  std::vector<Eigen::Vector3d> hands(n);
  body.positions(tip, n, joints.data(), hands.data());
  double worst = 0;
  for (int i = 0; i < n; ++i) worst = std::max(worst, (hands[i] - hand(&joints[4 * i])).norm());
  EXPECT_LT(worst, 1e-9);
}

TEST(Nao, HandIsTheSameWithTheWholeBody) {
  RobotModel model = load_urdf(kUrdf);
  const Body body(model, model.independent_joints());
  Rng rng(Seed(2).child("nao"));
  for (int i = 0; i < 100; ++i) {
    Eigen::VectorXd q(body.dof());
    for (int k = 0; k < q.size(); ++k) q[k] = rng.uniform(float(body.lower()[k]), float(body.upper()[k]));
    double arm[4];
    for (int k = 0; k < body.dof(); ++k) {
      if (body.moving()[k] == "RWristYaw") q[k] = 0;
      for (int j = 0; j < 4; ++j)
        if (body.moving()[k] == kRightArm[j]) arm[j] = q[k];
    }
    EXPECT_LT((body.position(model.link("r_gripper"), q.data()) - hand(arm)).norm(), 1e-12);
  }
}

TEST(Nao, LeftHandIsTheRightOneInTheMirror) {
  const Body left(load_urdf(kUrdf), {"LShoulderPitch", "LShoulderRoll", "LElbowYaw", "LElbowRoll"});
  Rng rng(Seed(3).child("nao"));
  for (int i = 0; i < 1000; ++i) {
    double q[4];
    for (int k = 0; k < 4; ++k)
      q[k] = left.lower()[k] + (left.upper()[k] - left.lower()[k]) * rng.uniform_double();
    const double mirrored[] = {q[0], -q[1], -q[2], -q[3]};
    const Eigen::Vector3d seen = hand(mirrored).cwiseProduct(Eigen::Vector3d(1, -1, 1));
    EXPECT_LT((left.position(left.model().link("l_gripper"), q) - seen).norm(), 1e-12);
  }
}

TEST(Nao, HasTwentyFiveIndependentJoints) {
  RobotModel model = load_urdf(kUrdf);
  EXPECT_EQ(model.independent_joints().size(), 25u);
  const Joint& follower = model.joints[model.joint("RHipYawPitch")];
  EXPECT_EQ(follower.mimic, model.joint("LHipYawPitch"));
  const Body hips(model, {"LHipYawPitch"});
  const double q = -0.6;
  const auto poses = hips.link_poses(Eigen::VectorXd::Constant(1, q));
  // The hips' axes mirror each other, so the right thigh is the left one seen in the mirror.
  const Eigen::Isometry3d left = poses[model.link("LPelvis")], right = poses[model.link("RPelvis")];
  const Eigen::Vector3d mirror(1, -1, 1);
  EXPECT_LT((right.translation() - mirror.cwiseProduct(left.translation())).norm(), 1e-12);
  EXPECT_LT((right.linear() - mirror.asDiagonal() * left.linear() * mirror.asDiagonal()).norm(), 1e-12);
  EXPECT_NEAR(Eigen::AngleAxisd(left.linear()).angle(), 0.6, 1e-12);
}

// The table summed from the file by another reader, with frames chained by hand (at zero, no frame is
// turned).
TEST(Nao, MassAndCentreAreTheTables) {
  tinyxml2::XMLDocument document;
  ASSERT_EQ(document.LoadFile(kUrdf.c_str()), tinyxml2::XML_SUCCESS);
  std::map<std::string, Eigen::Vector3d> at = {{"torso", {0, 0, 0}}};
  const auto triple = [](const char* text) {
    Eigen::Vector3d v;
    std::istringstream(text) >> v[0] >> v[1] >> v[2];
    return v;
  };
  double mass = 0;
  Eigen::Vector3d moment(0, 0, 0);
  tinyxml2::XMLElement* robot = document.RootElement();
  const auto child = [](tinyxml2::XMLElement* e, const char* a) { return e->FirstChildElement(a); };
  for (auto* e = child(robot, "joint"); e; e = e->NextSiblingElement("joint")) {
    ASSERT_TRUE(at.count(child(e, "parent")->Attribute("link")));
    at[child(e, "child")->Attribute("link")] =
        at[child(e, "parent")->Attribute("link")] + triple(child(e, "origin")->Attribute("xyz"));
  }
  for (auto* e = child(robot, "link"); e; e = e->NextSiblingElement("link")) {
    tinyxml2::XMLElement* inertial = child(e, "inertial");
    if (!inertial) continue;
    const double m = std::stod(child(inertial, "mass")->Attribute("value"));
    mass += m;
    moment += m * (at.at(e->Attribute("name")) + triple(child(inertial, "origin")->Attribute("xyz")));
  }
  EXPECT_NEAR(mass, 5.3054, 5e-5);
  RobotModel model = load_urdf(kUrdf);
  const Body whole(model, model.independent_joints());
  EXPECT_NEAR(whole.mass(), mass, 1e-12);
  EXPECT_LT((whole.centre_of_mass(Eigen::VectorXd::Zero(25)) - moment / mass).norm(), 1e-12);
}

}  // namespace
}  // namespace hbr
