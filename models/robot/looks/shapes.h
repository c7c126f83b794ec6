// Closed surfaces made from cross-sections: rounded boxes, capsules, cylinders, cones and all between them.
#pragma once

#include <vector>

#include "models/robot/looks/mesh.h"

namespace hbr::inline robots {

// A cross-section at height z: the superellipse |x / half_x|^power + |y / half_y|^power = 1 about the centre;
// power 2 is an ellipse, large powers come near to a rectangle.
struct Section {
  double z;
  Eigen::Vector2d half;
  double power = 2;
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
};

// How an end is closed: rounded off over `height` while the section shrinks by the share `round` of its size;
// with 1 it closes as a dome, with less a flat face is left.
struct Cap {
  double height;
  double round;
};

// The surface through the sections (at least one, ascending z; smooth between them) and its two caps.
Mesh loft(const std::vector<Section>& sections, const Cap& bottom, const Cap& top, int around = 40);

// About the origin; radius > 0, length is that of the straight part along z.
Mesh capsule(double radius, double length);
Mesh ellipsoid(const Eigen::Vector3d& half, double power = 2);
Mesh cylinder(double radius, double length, double rounding);
Mesh rounded_box(const Eigen::Vector3d& size, double rounding);
// A ring about z: `radius` to the middle of its tube.
Mesh torus(double radius, double tube);
// A capsule from a to b.
Mesh rod(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double radius);

}  // namespace hbr::inline robots
