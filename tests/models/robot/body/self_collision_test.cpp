#include "models/robot/body/self_collision.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "pipeline/core/random.h"
#include "tests/models/robot/body/chains.h"

namespace hbr {
namespace {

double distance(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0., 1.);
  return (p - a - t * (b - a)).norm();
}

bool collides(const SelfCollision& collision, const Body& body, const Eigen::VectorXd& joints) {
  return collision.collides(body.link_poses(joints));
}

// Four links in a plane; the capsules of the boxes are 0.05 thick and end 0.05 before the joints. Only links
// with one between them can meet, and they are apart where their segments are: brute force over one of them.
TEST(SelfCollision, IsThatOfCapsulesInThePlane) {
  const auto body = chain({{}, {}, {}, {}}, "0 0 1", kBox);
  const SelfCollision collision(*body);
  Rng rng(Seed(1).child("collision"));
  int collided = 0, tried = 0;
  for (int i = 0; i < 3000; ++i) {
    Eigen::Vector4d joints;
    for (double& q : joints) q = rng.uniform(-3.f, 3.f);
    std::vector<Eigen::Vector2d> from, to;
    Eigen::Vector2d at(0, 0);
    double heading = 0;
    for (int k = 0; k < 4; ++k) {
      heading += joints[k];
      const Eigen::Vector2d along(std::cos(heading), std::sin(heading));
      from.push_back(at + .05 * along), to.push_back(at + .95 * along);
      at += along;
    }
    double least = 10;
    for (const auto& [a, b] : {std::pair{0, 2}, {0, 3}, {1, 3}})
      for (int s = 0; s <= 400; ++s)
        least = std::min(least, distance(from[a] + s / 400. * (to[a] - from[a]), from[b], to[b]));
    if (std::abs(least - .1) < 2e-3) continue;
    ++tried;
    collided += least < .1;
    ASSERT_EQ(collides(collision, *body, joints), least < .1) << joints.transpose() << ": " << least;
  }
  EXPECT_GT(collided, 300);
  EXPECT_LT(collided, tried - 300);
}

// Without a visual the shape is the box of the same mass and inertia.
TEST(SelfCollision, TakesTheBoxOfTheInertia) {
  const std::string bar =
      R"(<inertial><origin xyz="0.5 0 0"/><mass value="12"/><inertia ixx="0.02" iyy="1.01" izz="1.01" ixy="0"
         ixz="0" iyz="0"/></inertial>)";  // 1 x 0.1 x 0.1 m
  const auto heavy = [&](const std::string& inside) {
    const TestFolder folder;
    std::string text = link("base", ""), parent = "base";
    for (int i = 0; i < 3; ++i) {
      text += link(fmt::format("l{}", i), inside) +
              fmt::format(R"(<joint name="j{0}" type="revolute"><parent link="{1}"/><child link="l{0}"/>
                             <origin xyz="{2} 0 0"/><axis xyz="0 0 1"/>
                             <limit lower="-3" upper="3" effort="1" velocity="1"/></joint>)",
                          i, parent, i ? 1 : 0);
      parent = fmt::format("l{}", i);
    }
    return std::make_shared<const Body>(load_urdf(folder.write("heavy.urdf", robot(text))),
                                        std::vector<std::string>{"j0", "j1", "j2"});
  };
  const auto by_inertia = heavy(bar), by_visual = heavy(bar + kBox);
  const SelfCollision a(*by_inertia), b(*by_visual);
  Rng rng(Seed(2).child("collision"));
  int collided = 0;
  for (int i = 0; i < 1000; ++i) {
    Eigen::Vector3d joints;
    for (double& q : joints) q = rng.uniform(-3.f, 3.f);
    EXPECT_EQ(collides(a, *by_inertia, joints), collides(b, *by_visual, joints)) << joints.transpose();
    collided += collides(a, *by_inertia, joints);
  }
  EXPECT_GT(collided, 50);
}

TEST(SelfCollision, LeavesOutWhatTouchesAtRest) {
  const std::string thick = R"(<visual><geometry><sphere radius="1.1"/></geometry></visual>)";
  const auto body = chain({{}, {}, {}}, "0 0 1", thick);  // the first and the third meet when stretched
  const Eigen::Vector3d folded(0, 3, 3);
  EXPECT_FALSE(collides(SelfCollision(*body), *body, folded));
}

}  // namespace
}  // namespace hbr
