// Finds a robot's drawing plane from nothing: the boards that its coarse reach promises, measured and refined
// by inverse kinematics.
#pragma once

#include <vector>

#include "models/robot/plane/board_rules.h"
#include "models/robot/plane/reach.h"
#include "models/robot/plane/reach_map.h"
#include "models/robot/plane/robot_settings.h"

namespace hbr::inline robots {

// A board and what of the points (drawing frame, m) the tip comes to there, within a tolerance.
struct FoundPlane {
  Board board{};
  double covered = 0;  // share of the points
  double worth = 0;    // BoardRules::worth
};

// Coverage comes first: while more than one point in two hundred is missing, fewer are better; between planes
// that cover so much, what is worth more.
bool better(const FoundPlane& a, const FoundPlane& b);

// The best plane for `points`, each of which counts as covered where `reach` comes within `tolerance` (m):
// the best boards of search_planes, each refined (refine_plane.h) where points are missing, made smaller by
// steps of 3 % and refined again until all are covered (but for one in two hundred); then the best of them,
// made larger by steps of 3 % and of 1 % for as long as either makes it better. Deterministic. Throws
// InputError where no board that the rules allow is within the robot's reach.
FoundPlane find_plane(const Body& body, const BoardRules& rules, const ReachMap& map, const Reach& reach,
                      const std::vector<Eigen::Vector2d>& points, double half_side, double tolerance,
                      const PlaneSearchSettings& settings, Workers& workers);

}  // namespace hbr::inline robots
