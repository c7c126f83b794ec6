// Where a robot draws: a similarity between the drawing frame (the arm's workspace, metres of the arm) and a
// plane of the robot's space (metres of the robot, the root link's frame).
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "pipeline/hierarchy/robot.h"

namespace hbr::inline robots {

struct DrawingPlane {
  Eigen::Vector3d origin;  // m: where the arm's base comes to lie
  Eigen::Vector3d u, v;    // unit: the directions of the frame's x and y
  double scale;            // metres of the robot per metre of the arm

  // Unit; towards the robot that looks at the drawing.
  Eigen::Vector3d normal() const { return u.cross(v); }
  Eigen::Vector3d to_robot(const Eigen::Vector2d& p) const { return origin + scale * (p[0] * u + p[1] * v); }
  Pen to_pen(const Eigen::Vector3d& hand) const {
    const Eigen::Vector3d d = hand - origin;
    return {Eigen::Vector2d(u.dot(d), v.dot(d)) / scale, normal().dot(d)};
  }

  // The plane that a robot looks at along the direction of that azimuth (about z, from x) and elevation
  // (upwards), with the drawing upright: the frame's x to the robot's right, its y up.
  static DrawingPlane facing(const Eigen::Vector3d& origin, double azimuth_rad, double elevation_rad,
                             double scale) {
    const double ca = std::cos(azimuth_rad), sa = std::sin(azimuth_rad);
    const double ce = std::cos(elevation_rad), se = std::sin(elevation_rad);
    return {origin, {sa, -ca, 0}, {-ca * se, -sa * se, ce}, scale};
  }
};

}  // namespace hbr::inline robots
