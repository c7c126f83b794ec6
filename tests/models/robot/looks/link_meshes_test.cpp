#include "models/robot/looks/shapes.h"
#include "tests/models/robot/description/urdf_text.h"
#include "tests/models/robot/looks/mesh_volume.h"

namespace hbr {
namespace {

TEST(LinkMeshes, MakeTheShapesOfTheUrdf) {
  const TestFolder folder;
  const auto shape = [](const std::string& inside) {
    return "<visual><origin xyz=\"1 2 3\"/><geometry>" + inside +
           "</geometry><material name=\"m\"><color rgba=\"1 0 0 1\"/></material></visual>";
  };
  const RobotModel model = load_urdf(folder.write(
      "a.urdf", robot(link("a", shape("<box size=\"1 2 3\"/>") + shape("<sphere radius=\"2\"/>") +
                                    shape("<cylinder radius=\"1\" length=\"4\"/>") +
                                    shape("<capsule radius=\"1\" length=\"4\"/>")))));
  const auto meshes = link_meshes(model, "", 1);
  ASSERT_EQ(meshes[0].size(), 4u);
  const double expected[] = {6, 4 * 3.14159 / 3 * 8, 3.14159 * 4, 3.14159 * (4 + 4. / 3)};
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(meshes[0][i].colour, Eigen::Vector3f(1, 0, 0));
    EXPECT_NEAR(volume({moved(meshes[0][i], Eigen::Isometry3d(Eigen::Translation3d(-1, -2, -3)))}),
                expected[i], 0.06 * expected[i]);
  }
}

// What the URDF and the profile say of a mesh's size multiplies; its place in the link is the URDF's.
TEST(LinkMeshes, AreScaledAndPlaced) {
  const TestFolder folder;
  save_scene(folder.path() / "a.obj", "obj", {{"ball", {ellipsoid({1, 1, 1})}}});
  const RobotModel model = load_urdf(
      folder.write("a.urdf", robot(link("a",
                                        "<visual><origin xyz=\"1 2 3\"/><geometry><mesh filename=\"a.obj\" "
                                        "scale=\"1 2 3\"/></geometry></visual>"))));
  Eigen::AlignedBox3f box;
  const auto meshes = link_meshes(model, "", 0.1);
  for (const Eigen::Vector3f& vertex : meshes.at(0).at(0).vertices) box.extend(vertex);
  EXPECT_LT((box.center() - Eigen::Vector3f(1, 2, 3)).norm(), .01);
  EXPECT_LT((box.sizes() - Eigen::Vector3f(.2f, .4f, .6f)).norm(), .01);
}

}  // namespace
}  // namespace hbr
