// Postures along places, moved by least squares until the joints turn as little as they can.
#pragma once

#include <vector>

#include "models/robot/plane/robot_on_plane.h"

namespace hbr::inline robots {

// The way [n] whose turns have the least sum of squares while the pen stays at the places [n] (m, in the root
// link's frame), within the limits, from `way` on; the postures that are kept are only brought within the
// limits. Collisions are not looked at.
std::vector<Eigen::VectorXd> straightened(const RobotOnPlane& robot,
                                          const std::vector<Eigen::Vector3d>& places,
                                          std::vector<Eigen::VectorXd> way, const std::vector<bool>& kept);

}  // namespace hbr::inline robots
