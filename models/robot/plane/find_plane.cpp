#include "models/robot/plane/find_plane.h"

#include <algorithm>

#include <fmt/ranges.h>

#include "models/robot/plane/refine_plane.h"
#include "models/robot/plane/search_plane.h"
#include "pipeline/core/check.h"

namespace hbr::inline robots {
namespace {

constexpr double kLarge = 1.03, kSmall = 1.01;  // steps of the scale
constexpr int kSteps = 12;
constexpr double kFull = 0.995;  // share of the points that is as good as all

}  // namespace

bool better(const FoundPlane& a, const FoundPlane& b) {
  if (const double full = std::min(a.covered, kFull), other = std::min(b.covered, kFull); full != other)
    return full > other;
  return a.worth > b.worth;
}

FoundPlane find_plane(const Body& body, const BoardRules& rules, const ReachMap& map, const Reach& reach,
                      const std::vector<Eigen::Vector2d>& points, double half_side, double tolerance,
                      const PlaneSearchSettings& settings, Workers& workers) {
  Postures postures;
  const auto measured = [&](const Board& board) {
    const auto distances = distances_to_reach(board, reach, points, workers, &postures);
    const auto near = std::ranges::count_if(distances, [&](double d) { return d <= tolerance; });
    return FoundPlane{board, static_cast<double>(near) / static_cast<double>(points.size()),
                      rules.worth(board)};
  };
  const auto refined = [&](const Board& start) {
    const FoundPlane found = measured(start);
    return found.covered >= kFull ? found
                                  : measured(refine_plane(start, rules, reach, points, workers, postures));
  };
  const auto scaled = [&](Board board, double factor) {
    board.plane.scale *= factor;
    return rules.raised(board);
  };
  FoundPlane best;
  for (const Board& start :
       search_planes(map, rules, points, half_side, shoulder(body), settings.refined, workers)) {
    if (best.covered >= kFull && rules.worth(start) <= best.worth) continue;
    postures.clear();
    FoundPlane smaller = refined(start), found = smaller;
    for (int i = 0; i < kSteps && found.covered < kFull; ++i) {
      if (best.covered >= kFull && smaller.worth <= best.worth) break;
      smaller = refined(scaled(smaller.board, 1 / kLarge));
      if (better(smaller, found)) found = smaller;
    }
    if (best.board.plane.scale == 0 || better(found, best)) best = found;
  }
  if (best.covered == 0)
    throw InputError(
        "{}: no board that faces the robot, with nothing below z = {:.3g} m, is where {} bring the pen; "
        "expected "
        "joints that move it over a plane, or in [robot_plane] board = \"any\" and below_floor = true",
        body.model().path.string(), rules.floor(), fmt::join(body.moving(), ", "));
  postures.clear();
  for (bool grown = true; grown;) {
    grown = false;
    for (const double step : {kLarge, kSmall})
      for (int i = 0; i < kSteps && best.covered >= kFull; ++i) {
        const FoundPlane larger = refined(scaled(best.board, step));
        if (!better(larger, best)) break;
        best = larger;
        grown = true;
      }
  }
  return best;
}

}  // namespace hbr::inline robots
