// Why a robot doesn't come where the arm was: of each place of a way, what stands between.
#pragma once

#include <array>
#include <vector>

#include "models/robot/plane/reach.h"
#include "models/robot/plane/robot_on_plane.h"
#include "pipeline/hierarchy/point_layer.h"

namespace hbr::inline robots {

// `gap`: the robot comes there, but layer 1 has no elite within l of it. `collision`: it would have to pass
// through itself or its board. `limit`: its joints do not go so far.
enum class Lack { none, gap, collision, limit };

// How many places of a way, m of the arm, lack what, by Lack.
using Lacks = std::array<int, 4>;
Lacks lacks_along(const RobotOnPlane& robot, const PointLayer& points, const Reach& reach,
                  const std::vector<Eigen::Vector2d>& places, double l);

}  // namespace hbr::inline robots
