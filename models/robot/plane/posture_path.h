// How a robot with joints to spare passes the places of a stroke while its joints turn as little as they can.
// Elites of layer 1 that are neighbours on the board may hold the arm quite differently; servos that go from
// one to the next leave board and line.
#pragma once

#include <vector>

#include "models/robot/plane/robot_on_plane.h"
#include "pipeline/hierarchy/point_layer.h"
#include "pipeline/hierarchy/trace.h"

namespace hbr::inline robots {

// How far the joints turn along configurations [n x dof], row-major: the sum of Euclidean distances, rad.
double joint_travel(const std::vector<double>& joints, Eigen::Index dof);

// Configurations [n x dof] for the places of a trace [n], within the joints' limits, the pen as near to each
// place as a tenth of the robot's tolerance, clear of itself and of its board; where that can't be had the
// trace's own. Candidates for a place are its own elite, inverse solutions from elites near it, and those of
// the place before carried on. The way through them has the least sum of squared distances (dynamic
// programming): between two places the pen leaves board and line about as the square of what the joints
// turn, so one turn is spread over many places rather than made at once. Where a jump of more than 0.5 rad is
// left, candidates are carried over the whole trace and back, and on from each towards the nearest others by
// small turns; of jumps that no such way avoids those are taken that bring the pen the least aside. The way
// is then straightened by least squares (Ceres) as a whole, but for places where that would leave what is
// possible. Never longer than the trace's own way.
std::vector<double> least_travel(const RobotOnPlane& robot, const PointLayer& points, const Trace& trace);

}  // namespace hbr::inline robots
