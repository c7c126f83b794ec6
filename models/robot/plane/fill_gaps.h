// Elites where a robot's layer of points has none though the robot can come there.
#pragma once

#include "models/robot/plane/points_on_plane.h"
#include "pipeline/core/random.h"

namespace hbr::inline robots {

// Gives each of the points [n x 2] (descriptors) that has no elite within `spacing` one of its own, where the
// robot comes there to within its tolerance and clear of itself and of its board. First from the nearest
// elites, whose child it is, again and again while that succeeds: the edge of a gap is where the next start
// stands. What is left then, by inverse kinematics from anywhere, without a parent. Ids go on after the last.
void fill_gaps(const RobotOnPlane& robot, const Frame& frame, const Rows& points, float spacing,
               Elites& elites, Seed seed);

}  // namespace hbr::inline robots
