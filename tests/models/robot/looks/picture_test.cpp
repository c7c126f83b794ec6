#include "models/robot/looks/picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "models/robot/looks/visible_links.h"
#include "tests/models/robot/body/chains.h"

namespace hbr {
namespace {

// Two links of 1 m of which the URDF shows nothing: rods from joint to joint stand in the picture.
TEST(DrawingScene, ShowsARobotWithoutVisuals) {
  const RobotOnPlane robot("bare", chain({Turn{}, Turn{}}, "1 0 0"), "tip",
                           DrawingPlane::facing({0, 0, 0}, 0, 0, 1), 0.01);
  std::vector<std::string> odd;
  const auto links = visible_links(robot.body().model(), "", 1, odd);
  EXPECT_THAT(odd, testing::ElementsAre(testing::HasSubstr("no link shows anything: drawn as rods")));
  const std::vector<double> joints{0.1, 0.2};
  const Scene scene = drawing_scene(robot, links, {joints, {Eigen::Vector2d(0.5, 0.5)}}, 0, 0.5);
  std::vector<std::string> names;
  for (const Posed& body : scene.bodies) names.push_back(body.name);
  EXPECT_THAT(names, testing::ElementsAre("base", "link0", "link1", "tip", "frame", "posts", "pane",
                                          "strokes", "pen"));
  // The last rod ends at the tip.
  const Eigen::Vector3d tip = robot.body().position(robot.tip(), joints.data());
  const Posed& last = scene.bodies[2];
  double nearest = 1, farthest = 0;  // m, of its surface from the tip
  for (const Mesh& mesh : last.meshes)
    for (const Eigen::Vector3f& vertex : mesh.vertices) {
      const double far = (last.pose * vertex.cast<double>() - tip).norm();
      nearest = std::min(nearest, far);
      farthest = std::max(farthest, far);
    }
  EXPECT_LT(nearest, 0.1);
  EXPECT_NEAR(farthest, 1, 0.15);
}

}  // namespace
}  // namespace hbr
