// Where in its space a robot can cover the arm's area, as large as it can: every direction and place at once,
// on the coarse map of its reach.
#pragma once

#include <vector>

#include "models/robot/plane/board_rules.h"
#include "models/robot/plane/reach_map.h"

namespace hbr::inline robots {

// Where the robot looks from, m: the first of the joints that draw.
Eigen::Vector3d shoulder(const Body& body);

// Boards that differ in direction by 20 degrees or more, those of the greatest worth first, at most `most`:
// on each the map reaches all points (drawing frame, m) but for one in two hundred, an empty cell beside a
// filled one counting as reached. Of each of the map's directions, the vertical ones and those in which the
// reach is flattest the largest board is found by trying every cell of the map as its origin; the largest
// ones are then moved, turned and grown by smaller and smaller steps for as long as that makes them better.
// The boards face `eye`. Deterministic. Empty where the map covers the
// points nowhere.
std::vector<Board> search_planes(const ReachMap& map, const BoardRules& rules,
                                 const std::vector<Eigen::Vector2d>& points, double half_side,
                                 const Eigen::Vector3d& eye, int most, Workers& workers);

}  // namespace hbr::inline robots
