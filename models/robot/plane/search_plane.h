// Finds a robot's drawing plane from nothing: where in its space it can cover the arm's area, as large as it
// can.
#pragma once

#include <vector>

#include "models/robot/plane/drawing_plane.h"
#include "models/robot/plane/reach.h"
#include "models/robot/plane/reach_map.h"
#include "models/robot/plane/robot_settings.h"

namespace hbr {

// A board and what of the points (drawing frame, m) the tip comes to there, within a tolerance.
struct FoundPlane {
  Board board{};
  double covered = 0;  // share of the points
  double worth = 0;    // see below
};

// What a board is worth: its scale; less where it leans, by the fourth power of its angle's cosine (a tenth
// off at 13 degrees, half at 34), down to a tenth where it lies level, since robots turn about level axes and
// have many boards alike, of which one before them is meant; half of it again where what never moves of the
// robot stands in it.
double plane_worth(const Board& board, const Clearance& clearance);

// Coverage comes first: while more than one point in two hundred is missing, fewer are better; between planes
// that cover so much, what is worth more.
bool better(const FoundPlane& a, const FoundPlane& b);

// Planes that differ in direction by 20 degrees or more, the best first, at most `most` of them: MAP-Elites
// (pipeline/qd) over the direction in which the robot looks, of planes in the reach's box at scales from an
// eighth of the greatest that fits the box upwards. `eye` is where the robot looks from: the planes face it.
std::vector<Board> search_planes(const ReachMap& map, const Clearance& clearance,
                                 const std::vector<Eigen::Vector2d>& points, double half_side,
                                 const Eigen::Vector3d& eye, int most, const PlaneSearchSettings& settings,
                                 Seed seed, Workers& workers);

// The best plane for `points`, each of which counts as covered where `reach` comes within `tolerance` (m):
// the best planes of the search above, each refined (refine_plane.h) where points are missing, made smaller
// by steps of 3 % and refined again until all are covered (but for one in two hundred); then the best of
// them, made larger by steps of 3 % and of 1 % for as long as that makes it better. Deterministic.
FoundPlane find_plane(const Body& body, const Clearance& clearance, const ReachMap& map, const Reach& reach,
                      const std::vector<Eigen::Vector2d>& points, double half_side, double tolerance,
                      const PlaneSearchSettings& settings, Seed seed, Workers& workers);

}  // namespace hbr
