// Places a robot's drawing plane so that it reaches the arm's area.
#pragma once

#include <vector>

#include "models/robot/plane/board_rules.h"
#include "models/robot/plane/reach.h"
#include "pipeline/core/parallel.h"

namespace hbr::inline robots {

// Of each point, the joints [dof] where the tip last came nearest to it; empty before the first time. Inverse
// kinematics begins there.
using Postures = std::vector<Eigen::VectorXd>;

// Moves origin, direction and a little the scale of a plane (Ceres, Levenberg-Marquardt) so that the sum of
// the squared distances between `points` (drawing frame, m) on the plane and the tip's reach beside the board
// becomes least, and nothing of the board lies below the floor; the plane's start is a weak prior (an eighth
// of the drawing's radius, 0.1 rad, 0.5 % of the scale weigh as much as a root mean square distance of 1/3000
// of the radius). The drawing stays upright (see DrawingPlane::facing), leans by at most 5 degrees more or
// less, and is of the kind that is asked for. The start must be such a plane.
Board refine_plane(const Board& start, const BoardRules& rules, const Reach& reach,
                   const std::vector<Eigen::Vector2d>& points, Workers& workers, Postures postures = {});

// Of each point: the distance in metres of the robot between the point on the plane and the nearest position
// of the tip. The postures, where they are given, become those that were found.
std::vector<double> distances_to_reach(const Board& board, const Reach& reach,
                                       const std::vector<Eigen::Vector2d>& points, Workers& workers,
                                       Postures* postures = nullptr);

}  // namespace hbr::inline robots
