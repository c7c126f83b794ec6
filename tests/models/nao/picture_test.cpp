// The picture of NAO at its board shows what was drawn, and NAO in its colours.
#include "models/robot/looks/picture.h"

#include <gtest/gtest.h>

#include "models/nao/nao_meshes.h"
#include "tests/models/nao/right_arm.h"

namespace hbr {
namespace {

class NaoPicture : public testing::Test {
 protected:
  NaoPicture()
      : robot_(make_robot(nao_right_arm(), DrawingPlane::facing({.143, -.152, .090}, -.38, -.07, .258))) {
    const auto shells = nao_meshes();
    for (const Link& link : robot_.body().model().links) {
      meshes_.emplace_back();
      for (const Visual& visual : link.visuals)
        meshes_.back() = shells.at(std::filesystem::path(visual.mesh).stem());
    }
    // An L of 12 pieces; the pen stands still at its corner.
    const Eigen::Vector4d posture(-.1, -.3, 1.2, .6);
    add({-.2, .3}, posture);
    for (int i = 1; i <= 8; ++i) add({-.2, .3 - .06 * i}, posture);
    add({-.2, .3 - .06 * 8}, posture);
    for (int i = 1; i <= 4; ++i) add({-.2 + .06 * i, -.18}, posture);
  }
  void add(const Eigen::Vector2d& pen, const Eigen::Vector4d& posture) {
    drawing_.pen.push_back(pen);
    drawing_.joints.insert(drawing_.joints.end(), posture.begin(), posture.end());
  }
  Scene scene(std::size_t at) const { return drawing_scene(robot_, meshes_, drawing_, at, .6); }
  static const Posed& part(const Scene& scene, const std::string& name) {
    for (const Posed& body : scene.bodies)
      if (body.name == name) return body;
    throw std::out_of_range(name);
  }
  static Eigen::AlignedBox3d box(const Posed& body) {
    Eigen::AlignedBox3d all;
    for (const Mesh& mesh : body.meshes)
      for (const Eigen::Vector3f& vertex : mesh.vertices) all.extend(body.pose * vertex.cast<double>());
    return all;
  }

  RobotOnPlane robot_;
  std::vector<std::vector<Mesh>> meshes_;
  DrawnStroke drawing_;
};

TEST_F(NaoPicture, HasAStrokeForEachPieceDrawnSoFar) {
  for (const auto& [at, pieces] : {std::pair(0, 0), {1, 1}, {8, 8}, {9, 8}, {13, 12}})
    EXPECT_EQ(part(scene(at), "strokes").meshes.size(), static_cast<std::size_t>(pieces)) << at;
  // They lie on the plane, from the first point to the last.
  const Posed strokes = part(scene(13), "strokes");
  Eigen::AlignedBox2d drawn;
  for (const Mesh& mesh : strokes.meshes)
    for (const Eigen::Vector3f& vertex : mesh.vertices) {
      const Pen pen = robot_.plane().to_pen(vertex.cast<double>());
      EXPECT_LT(std::abs(pen.off_plane), .004);
      drawn.extend(pen.position);
    }
  EXPECT_LT((drawn.min() - Eigen::Vector2d(-.2, -.18)).norm(), .02);
  EXPECT_LT((drawn.max() - Eigen::Vector2d(.04, .3)).norm(), .02);
}

TEST_F(NaoPicture, HoldsThePenAtThePointDrawnLast) {
  for (const std::size_t at : {0u, 9u, 13u}) {
    const Posed pen = part(scene(at), "pen");
    const Eigen::Vector3d point = robot_.plane().to_robot(drawing_.pen[at]);
    EXPECT_LT((pen.pose.translation() - point).norm(), 1e-12);
    // It is on the robot's side, and its other end is away from the board.
    double nearest = 1, farthest = 0;
    for (const Mesh& mesh : pen.meshes)
      for (const Eigen::Vector3f& vertex : mesh.vertices) {
        const Eigen::Vector3d at_robot = pen.pose * vertex.cast<double>();
        nearest = std::min(nearest, (at_robot - point).norm());
        farthest = std::max(farthest, (at_robot - point).dot(robot_.plane().normal()));
      }
    EXPECT_LT(nearest, .002);
    EXPECT_GT(farthest, .03);
  }
}

TEST_F(NaoPicture, StandsOnTheFloorBeforeItsBoard) {
  const Scene all = scene(13);
  EXPECT_NEAR(box(part(all, "l_ankle")).min()[2], all.floor, 1e-6);
  EXPECT_NEAR(box(part(all, "posts")).min()[2], all.floor, .01);
  const Posed pane = part(all, "pane");
  EXPECT_LT(pane.meshes[0].opacity, 1);
  EXPECT_NEAR(box({"", pane.meshes}).sizes()[0], 2 * .6 * .258, 1e-3);
}

// Share of the pixels near a colour, whatever its brightness.
double share(const cv::Mat3b& picture, const Eigen::Vector3f& colour, float least, float most) {
  int found = 0;
  for (const cv::Vec3b& pixel : picture) {
    const Eigen::Vector3f seen(pixel[2] / 255.f, pixel[1] / 255.f, pixel[0] / 255.f);
    const float bright = seen.maxCoeff();
    found += bright >= least && bright <= most &&
             (seen / std::max(bright, .01f) - colour / colour.maxCoeff()).cwiseAbs().maxCoeff() < .13f;
  }
  return found / static_cast<double>(picture.total());
}

TEST_F(NaoPicture, ShowsWhiteAndBlueShellsAndTheInk) {
  const Scene all = scene(13), none = scene(0);
  const Camera camera = camera_for(all, view_over_shoulder(robot_.plane()), .42, .75);
  const cv::Mat3b drawn = render(all, camera, 240, 320), blank = render(none, camera, 240, 320);
  const Eigen::Vector3f blue(.27f, .43f, .62f), ink(.86f, .22f, .12f), grey(1, 1, 1);
  EXPECT_GT(share(drawn, blue, .2f, .75f), .01);
  EXPECT_GT(share(drawn, grey, .5f, 1), .1);
  EXPECT_GT(share(drawn, ink, .3f, 1), share(blank, ink, .3f, 1) + .0005);
  int changed = 0;
  for (int row = 0; row < drawn.rows; ++row)
    for (int column = 0; column < drawn.cols; ++column) changed += drawn(row, column) != blank(row, column);
  EXPECT_GT(changed, 100);             // the strokes and the pen
  EXPECT_LT(changed, 240 * 320 / 10);  // and nothing else
}

}  // namespace
}  // namespace hbr
