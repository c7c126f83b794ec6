// What is looked at, and from where.
#pragma once

#include <vector>

#include "models/robot/looks/mesh_file.h"

namespace hbr::inline robots {

struct Scene {
  std::vector<Posed> bodies;  // what is seen through is convex and casts no shadow
  double floor = 0;           // z of the ground, m
};

struct Camera {
  Eigen::Vector3d eye, target;  // m; z is up in the picture
  double view_rad;              // angle over the picture's height
};

// A camera that looks along `direction` at everything in the scene, which fills the picture but for a margin.
Camera camera_for(const Scene& scene, const Eigen::Vector3d& direction, double view_rad, double aspect);

}  // namespace hbr::inline robots
