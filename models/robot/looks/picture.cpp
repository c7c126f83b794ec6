#include "models/robot/looks/picture.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "models/robot/looks/shapes.h"
#include "pipeline/core/check.h"

namespace hbr::inline robots {
namespace {

const Eigen::Vector3f kInk(0.86f, 0.22f, 0.12f), kGlass(0.80f, 0.90f, 0.95f), kFrame(0.55f, 0.60f, 0.66f);

// Lengths below are those of a board for NAO; larger robots have larger boards and thicker pens.
double enlarged(const DrawingPlane& plane) { return plane.scale / 0.258; }

Posed strokes(const DrawingPlane& plane, const DrawnStroke& drawing, std::size_t last) {
  Posed ink{"strokes", {}};
  const double radius = 0.0024 * enlarged(plane), shortest = 1e-4 * enlarged(plane);  // m
  Eigen::Vector3d from = plane.to_robot(drawing.pen[0]);
  for (std::size_t i = 1; i <= last; ++i) {
    const Eigen::Vector3d to = plane.to_robot(drawing.pen[i]);
    if ((to - from).norm() < shortest) continue;
    ink.meshes.push_back(coloured(rod(from, to, radius), kInk));
    from = to;
  }
  return ink;
}

// A pane behind the plane, framed, on two posts that stand on the floor.
std::vector<Posed> board(const DrawingPlane& plane, double half_side, double floor) {
  const double half = plane.scale * half_side, rail = 0.004 * enlarged(plane);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear().col(0) = plane.u;
  pose.linear().col(1) = plane.v;
  pose.linear().col(2) = plane.normal();
  pose.translation() = plane.origin - rail * plane.normal();
  Mesh pane = coloured(rounded_box({2 * half, 2 * half, rail}, rail / 4), kGlass);
  pane.opacity = 0.16f;
  Posed frame{"frame", {}, pose};
  for (const double side : {-1., 1.}) {
    frame.meshes.push_back(coloured(rod({-half, side * half, 0}, {half, side * half, 0}, rail), kFrame));
    frame.meshes.push_back(coloured(rod({side * half, -half, 0}, {side * half, half, 0}, rail), kFrame));
  }
  Posed posts{"posts", {}};
  for (const double side : {-1., 1.}) {
    const Eigen::Vector3d corner = pose * Eigen::Vector3d(side * half, -half, 0);
    const Eigen::Vector3d foot(corner[0], corner[1], floor + rail);
    if (corner[2] - foot[2] < 2 * rail) continue;
    const Eigen::Vector3d forth =
        Eigen::Vector3d(plane.normal()[0], plane.normal()[1], 0).normalized() * (12.5 * rail);
    posts.meshes.push_back(coloured(rod(corner, foot, rail), kFrame));
    posts.meshes.push_back(coloured(rod(foot - forth, foot + forth, rail), kFrame));
  }
  return {frame, posts, {"pane", {pane}, pose}};
}

// Its point is on the drawing; it leans from the plane's normal towards the hand's back.
Posed pen(const Eigen::Isometry3d& hand, const DrawingPlane& plane, const Eigen::Vector3d& point) {
  const Eigen::Vector3d lean = (0.9 * plane.normal() + 0.5 * hand.linear().col(2)).normalized();
  const double length = std::sqrt(enlarged(plane));  // hands differ less than boards
  // A cone of ink and the pen's body; sizes in metres where `length` is 1.
  const auto turned = [&](double z0, double r0, double z1, double r1, Cap low, Cap high) {
    low.height *= length, high.height *= length;
    return loft({{z0 * length, Eigen::Vector2d::Constant(r0 * length)},
                 {z1 * length, Eigen::Vector2d::Constant(r1 * length)}},
                low, high, 24);
  };
  Posed posed{"pen", {}};
  posed.pose.translate(point);
  posed.pose.rotate(Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), lean));
  posed.meshes = {coloured(turned(.001, .0012, .012, .0042, {.001, .9}, {.001, .2}), kInk),
                  coloured(turned(.013, .0042, .085, .0042, {.001, .2}, {.003, .7}), {0.15f, 0.16f, 0.18f})};
  return posed;
}

// `back_rad` from where the robot looks, seen from the right where the board lies to the robot's right.
Eigen::Vector3d level_view(const DrawingPlane& plane, double back_rad, double down_rad) {
  const Eigen::Vector3d looks = -plane.normal();
  const double turn_rad = plane.u.dot(plane.origin) >= 0 ? 0.95 : -0.95;
  const double azimuth = std::atan2(looks[1], looks[0]) + back_rad + turn_rad;
  return {std::cos(down_rad) * std::cos(azimuth), std::cos(down_rad) * std::sin(azimuth),
          -std::sin(down_rad)};
}

}  // namespace

Scene drawing_scene(const RobotOnPlane& robot, const std::vector<std::vector<Mesh>>& meshes,
                    const DrawnStroke& drawing, std::size_t at, double half_side) {
  const Eigen::Index dof = robot.dof();
  HBR_CHECK(
      at < drawing.pen.size() && drawing.joints.size() == drawing.pen.size() * static_cast<std::size_t>(dof),
      "at {}, pen {}, joints {}", at, drawing.pen.size(), drawing.joints.size());
  const Eigen::VectorXd joints =
      Eigen::Map<const Eigen::VectorXd>(drawing.joints.data() + static_cast<Eigen::Index>(at) * dof, dof);
  const std::vector<Eigen::Isometry3d> poses = robot.body().link_poses(joints);
  Scene scene;
  scene.floor = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    if (meshes[i].empty()) continue;
    scene.bodies.push_back({robot.body().model().links[i].name, meshes[i], poses[i]});
    for (const Mesh& mesh : meshes[i])
      for (const Eigen::Vector3f& vertex : mesh.vertices)
        scene.floor = std::min(scene.floor, (poses[i] * vertex.cast<double>())[2]);
  }
  const DrawingPlane& plane = robot.plane();
  scene.floor = std::min(scene.floor, plane.origin[2] - plane.scale * half_side);
  for (Posed& part : board(plane, half_side, scene.floor)) scene.bodies.push_back(std::move(part));
  scene.bodies.push_back(strokes(plane, drawing, at));
  scene.bodies.push_back(
      pen(poses[static_cast<std::size_t>(robot.tip())], plane, plane.to_robot(drawing.pen[at])));
  return scene;
}

Eigen::Vector3d view_from_front(const DrawingPlane& plane) {
  return level_view(plane, std::numbers::pi, 0.16);
}

Eigen::Vector3d view_over_shoulder(const DrawingPlane& plane) { return level_view(plane, 0, 0.20); }

}  // namespace hbr::inline robots
