// A robot at its board.
#pragma once

#include "models/robot/looks/render.h"
#include "models/robot/plane/robot_on_plane.h"

namespace hbr::inline robots {

// What was drawn: joints [m x dof] in radians, row-major, and the pen there [m], metres of the arm.
struct DrawnStroke {
  std::vector<double> joints;
  std::vector<Eigen::Vector2d> pen;
};

// The robot (meshes of each of its links) in the drawing's posture `at`, a pen in its hand, before a glass
// board of the size of the arm's drawing area [-half_side, half_side]^2 with the strokes up to there.
Scene drawing_scene(const RobotOnPlane& robot, const std::vector<std::vector<Mesh>>& meshes,
                    const DrawnStroke& drawing, std::size_t at, double half_side);

// Three-quarter view from before the board, which shows the robot's face; and over its shoulder, which shows
// the drawing as the robot sees it; both from the side of the arm that draws. Directions in which the viewer
// looks.
Eigen::Vector3d view_from_front(const DrawingPlane& plane);
Eigen::Vector3d view_over_shoulder(const DrawingPlane& plane);

}  // namespace hbr::inline robots
