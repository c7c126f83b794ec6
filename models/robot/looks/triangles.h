// A scene as the triangles that a picture is made of.
#pragma once

#include <vector>

#include "models/robot/looks/mesh_file.h"

namespace hbr::inline robots {

// Light is linear; pictures are sRGB.
Eigen::Vector3f to_linear(const Eigen::Vector3f& colour);

struct Triangle {
  Eigen::Vector3f corner[3], normal[3];
  Eigen::Vector3f colour;  // linear
  float opacity;
};

// Those that are solid, or those that are seen through.
std::vector<Triangle> triangles_of(const std::vector<Posed>& bodies, bool solid);

// Rows: right, down, forward.
Eigen::Matrix3f axes_along(const Eigen::Vector3f& forward);

}  // namespace hbr::inline robots
