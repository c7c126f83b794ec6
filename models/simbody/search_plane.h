// Finds a robot's drawing plane from nothing: where in its space it can cover the arm's area, as large as it
// can.
#pragma once

#include <vector>

#include "models/simbody/drawing_plane.h"
#include "models/simbody/reach.h"
#include "models/simbody/reach_map.h"
#include "models/simbody/robot_settings.h"

namespace hbr {

// A plane and what of the points (drawing frame, m) the tip comes to there, within a tolerance.
struct FoundPlane {
  DrawingPlane plane{};
  double covered = 0;  // share of the points
};

// Coverage comes first: while a point is missing, fewer missing points are better; between planes that cover
// all, the larger scale is better, and a plane that lies level must be a tenth larger than one that stands
// upright.
bool better(const FoundPlane& a, const FoundPlane& b);

// Planes that differ in direction by 20 degrees or more, the best first, at most `most` of them: MAP-Elites
// (pipeline/qd) over the direction in which the robot looks, of planes in the reach's box at scales from an
// eighth of the greatest that fits the box upwards. `eye` is where the robot looks from: the planes face it.
std::vector<DrawingPlane> search_planes(const ReachMap& map, const std::vector<Eigen::Vector2d>& points,
                                        const Eigen::Vector3d& eye, int most,
                                        const PlaneSearchSettings& settings, Seed seed, Workers& workers);

// The best plane for `points`, each of which counts as covered where `reach` comes within `tolerance` (m):
// the best planes of the search above, each refined (refine_plane.h) where a point is missing, and made
// smaller by steps of 1 % and refined again for as long as that covers more; then the best of them, made
// larger by steps of 4 % and of 1 % for as long as all stays covered. Deterministic.
FoundPlane find_plane(const Body& body, const ReachMap& map, const Reach& reach,
                      const std::vector<Eigen::Vector2d>& points, double tolerance,
                      const PlaneSearchSettings& settings, Seed seed, Workers& workers);

}  // namespace hbr
