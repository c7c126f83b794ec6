#include "models/robot/looks/robot_shape.h"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "models/robot/looks/mesh_file.h"

namespace hbr {
namespace {

// The six-joint arm, posed by the shape's parts alone, fills what its links' meshes do where Simbody has
// them.
TEST(RobotShape, PutsEveryLinksSurfaceInItsPart) {
  const RobotModel model = load_urdf(HBR_SOURCE_DIR "/models/industrial/six_joint_arm.urdf");
  const Body body(model, {"turn", "elbow"}, {{"shoulder", 0.4}, {"bend", -0.3}});
  const auto meshes = link_meshes(model, "", 1);
  std::size_t triangles = 0;
  Eigen::AlignedBox3d box, expected;  // around all of it, in this posture
  const std::vector<Eigen::Isometry3d> poses = body.link_poses(Eigen::Vector2d(0.7, -0.9));
  for (std::size_t link = 0; link < meshes.size(); ++link)
    for (const Mesh& mesh : meshes[link]) {
      triangles += mesh.triangles.size();
      for (const Eigen::Vector3f& vertex : mesh.vertices)
        expected.extend(Eigen::Vector3d(poses[link] * vertex.cast<double>()));
    }
  Workers workers(1);
  const RobotShape shape = shape_of(body, meshes, triangles, 0, workers);
  EXPECT_EQ(shape.deviation, 0);
  ASSERT_EQ(shape.parts.size(), 3u);

  const Eigen::Vector2d q(0.7, -0.9);
  std::vector<Eigen::Isometry3d> frames(1, Eigen::Isometry3d::Identity());
  for (std::size_t i = 1; i < 3; ++i) {
    const MovingPart& part = shape.parts[i];
    frames.push_back(frames[static_cast<std::size_t>(part.parent)] * part.origin *
                     Eigen::AngleAxisd(q[part.coordinate], part.axis));
  }
  std::size_t shown = 0;
  std::set<std::pair<int, std::tuple<float, float, float>>> seen;
  for (const auto& [part, mesh] : shape.pieces) {
    shown += mesh.triangles.size();
    EXPECT_TRUE(seen.insert({part, {mesh.colour[0], mesh.colour[1], mesh.colour[2]}}).second)
        << "a part has two pieces of one colour";
    for (const Eigen::Vector3i& t : mesh.triangles)
      ASSERT_TRUE(t.minCoeff() >= 0 && t.maxCoeff() < static_cast<int>(mesh.vertices.size()));
    for (const Eigen::Vector3f& vertex : mesh.vertices)
      box.extend(Eigen::Vector3d(frames[static_cast<std::size_t>(part)] * vertex.cast<double>()));
  }
  EXPECT_EQ(shown, triangles);
  EXPECT_LT((box.min() - expected.min()).norm() + (box.max() - expected.max()).norm(), 1e-5);
}

}  // namespace
}  // namespace hbr
