// Coarse shapes of a robot's links.
#pragma once

#include <vector>

#include "models/robot/description/robot_model.h"

namespace hbr::inline robots {

// All that is within `radius` of the segment from `middle` - `half` to `middle` + `half`, m, in the frame of
// its link.
struct Capsule {
  int link;
  Eigen::Vector3d middle, half;
  double radius;
  double reach() const { return half.norm() + radius; }
  Capsule at(const Eigen::Isometry3d& pose) const {
    return {link, pose * middle, pose.linear() * half, radius};
  }
};

// A link's visual boxes, cylinders and spheres as capsules; where it has none (meshes say nothing here), the
// capsule of the solid box that has its mass and inertia. Where that box is lighter than foam, the masses of
// the URDF are not those of a body of that shape: rods from the link's frame to those of the links that hang
// on it stand for it, where there are any.
std::vector<Capsule> capsules_of(const RobotModel& model, int link);

// Least squared distance between the segments of two capsules in one frame, m^2.
double squared_distance(const Capsule& a, const Capsule& b);

}  // namespace hbr::inline robots
