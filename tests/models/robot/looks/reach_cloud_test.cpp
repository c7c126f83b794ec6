#include "models/robot/looks/reach_cloud.h"

#include <gtest/gtest.h>

#include "tests/models/robot/body/flat_joints.h"
#include "tests/models/robot/description/urdf_text.h"

namespace hbr {
namespace {

// A hand that slides from 1 to 3 m off: a closed octahedron for each posture, from blue to red as it is far.
TEST(ReachCloud, HasAPointForEachPosture) {
  const RobotModel model =
      load(link("a") + link("b") +
           R"(<joint name="j" type="prismatic"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/>)" +
           limit(1, 3) + "</joint>");
  const Posed cloud = reach_cloud(chains_of(model).at(0), 500, 10);
  std::size_t triangles = 0;
  double farthest = 0;
  for (const Mesh& mesh : cloud.meshes) {
    EXPECT_LT(mesh.opacity, 1);
    triangles += mesh.triangles.size();
    ASSERT_EQ(mesh.vertices.size() % 6, 0u);
    for (const Eigen::Vector3i& t : mesh.triangles) {
      const int point = t[0] / 6;
      Eigen::Vector3f centre = Eigen::Vector3f::Zero();
      for (int k = 0; k < 6; ++k) centre += mesh.vertices[6 * point + k] / 6;
      const Eigen::Vector3f &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
      EXPECT_EQ(t[1] / 6, point);
      EXPECT_EQ(t[2] / 6, point);
      EXPECT_GT((b - a).cross(c - a).dot(a - centre), 0) << "seen from outside";
      EXPECT_NEAR((a - centre).norm(), .02, 1e-5);
      EXPECT_GE(centre[2], .999f);
      EXPECT_LE(centre[2], 3.001f);
    }
    for (const Eigen::Vector3f& vertex : mesh.vertices) {
      EXPECT_GT(vertex[2], farthest - .18) << "a nearer one in a later colour";
      farthest = std::max<double>(farthest, vertex[2]);
    }
  }
  EXPECT_EQ(triangles, 8 * 500u);
  EXPECT_TRUE(cloud.meshes.front().vertices.empty());  // nothing at the joint itself
  EXPECT_GT(cloud.meshes.front().colour[2], cloud.meshes.front().colour[0]);
  EXPECT_GT(cloud.meshes.back().colour[0], cloud.meshes.back().colour[2]);
}

}  // namespace
}  // namespace hbr
