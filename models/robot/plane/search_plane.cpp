#include "models/robot/plane/search_plane.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hbr::inline robots {
namespace {

constexpr double kSmallest = 1. / 32;  // of the largest scale that could fit the map's box
constexpr double kGrowth = 1.03;       // a step of the scale
constexpr double kApart = 20 * std::numbers::pi / 180;
constexpr double kMissing = 0.005;  // share of the points that may be missing
constexpr int kHalvings = 5;        // of the steps by which a board is moved and turned

// A board's place, as the search varies it.
struct BoardPlace {
  Eigen::Vector3d origin;
  double azimuth, elevation, scale;
};

class BoardSearch {
 public:
  BoardSearch(const ReachMap& map, const BoardRules& rules, const std::vector<Eigen::Vector2d>& points,
              double half_side, const Eigen::Vector3d& eye)
      : map_(map), rules_(rules), points_(points), half_side_(half_side), eye_(eye) {
    double radius = 1e-9;  // m of the arm
    for (const Eigen::Vector2d& p : points) radius = std::max(radius, p.norm());
    most_missing_ = static_cast<int>(kMissing * static_cast<double>(points.size()));
    largest_ = map.box().diagonal().norm() / 2 / radius;
  }

  Board board(const BoardPlace& pose) const {
    return {DrawingPlane::facing(pose.origin, pose.azimuth, pose.elevation, pose.scale), half_side_};
  }

  // The best board in a direction over every cell as its origin; of scale 0 where none covers the points.
  BoardPlace best_facing(const Eigen::Vector3d& normal) const {
    const double elevation = -std::asin(std::clamp(normal[2], -1., 1.));
    const int facing = nearest_direction(normal);
    const bool vertical = std::hypot(normal[0], normal[1]) < 1e-6;
    BoardPlace best{{}, 0, 0, 0};
    double least = kSmallest * largest_;  // worth
    const Eigen::Vector3d sizes = map_.box().sizes();
    const Eigen::Vector3i cells = (sizes / map_.cell()).array().ceil().cast<int>().max(1);
    for (int z = 0; z < cells[2]; ++z)
      for (int y = 0; y < cells[1]; ++y)
        for (int x = 0; x < cells[0]; ++x) {
          const Eigen::Vector3d origin =
              map_.box().min() +
              sizes.cwiseProduct(
                  Eigen::Vector3d(x + 0.5, y + 0.5, z + 0.5).cwiseQuotient(cells.cast<double>()));
          // Of a level board, up is away from the robot.
          const Eigen::Vector3d away = vertical ? Eigen::Vector3d(origin - eye_) : Eigen::Vector3d(-normal);
          const double azimuth = std::atan2(away[1], away[0]);
          grow({origin, azimuth, elevation, 0}, facing, least, best);
        }
    return best;
  }

  // Moves, turns and grows by the steps that make it better, then by halved ones.
  BoardPlace climbed(BoardPlace best) const {
    double least = rules_.worth(board(best)), move = 2 * map_.cell(), turn = kApart / 2;
    for (int halving = 0; halving < kHalvings; ++halving, move /= 2, turn /= 2)
      for (bool better = true; better;) {
        better = false;
        for (int axis = 0; axis < 5; ++axis)
          for (const double way : {-1., 1.}) {
            BoardPlace tried = best;
            if (axis < 3) tried.origin[axis] += way * move;
            if (axis == 3) tried.azimuth += way * turn;
            if (axis == 4)
              tried.elevation = std::clamp(best.elevation + way * turn, -std::numbers::pi / 2, 0.);
            better |= grow(tried, nearest_direction(board(tried).plane.normal()), least, best);
          }
      }
    return best;
  }

 private:
  // The largest board there whose worth is above `least` takes the place of `best`.
  bool grow(BoardPlace pose, int facing, double& least, BoardPlace& best) const {
    bool better = false;
    for (;;) {
      pose.scale = least * kGrowth;
      if (!covers(board(pose), facing)) return better;
      // A scale is worth so much at most; where it is worth less, a larger one must do.
      for (double worth = 0; (worth = rules_.worth(board(pose))) < least * kGrowth * (1 - 1e-9);) {
        pose.scale *= least * kGrowth / worth;
        if (pose.scale > largest_ || !covers(board(pose), facing)) return better;
      }
      least = rules_.worth(board(pose));
      best = pose;
      better = true;
    }
  }

  bool covers(const Board& candidate, int facing) const {
    const Eigen::Vector3d normal = candidate.plane.normal();
    if ((eye_ - candidate.plane.origin).dot(normal) < -map_.cell() || !rules_.allows(candidate)) return false;
    int missing = 0;
    for (const Eigen::Vector2d& p : points_)
      if (map_.distance(candidate.plane.to_robot(p), facing) > 1.001 * map_.cell() &&
          ++missing > most_missing_)
        return false;
    return true;
  }

  const ReachMap& map_;
  const BoardRules& rules_;
  const std::vector<Eigen::Vector2d>& points_;
  double half_side_;
  Eigen::Vector3d eye_;
  double largest_ = 0;
  int most_missing_ = 0;
};

// Normals of boards that don't hang over: what would do so a little stands upright instead.
std::vector<Eigen::Vector3d> directions(const ReachMap& map) {
  std::vector<Eigen::Vector3d> result{{0, 0, 1}, map.flattest(), -map.flattest()};
  for (int i = 0; i < kDirections; ++i) result.push_back(direction(i));
  std::erase_if(result, [](const Eigen::Vector3d& normal) { return normal[2] < -0.3; });
  for (Eigen::Vector3d& normal : result)
    if (normal[2] < 0) normal = Eigen::Vector3d(normal[0], normal[1], 0).normalized();
  return result;
}

}  // namespace

Eigen::Vector3d shoulder(const Body& body) {
  int first = static_cast<int>(body.model().joints.size());
  for (const std::string& name : body.moving()) first = std::min(first, body.model().joint(name));
  const Eigen::VectorXd middle = (body.lower() + body.upper()) / 2;
  return body.link_poses(middle)[body.model().joints[first].child].translation();
}

std::vector<Board> search_planes(const ReachMap& map, const BoardRules& rules,
                                 const std::vector<Eigen::Vector2d>& points, double half_side,
                                 const Eigen::Vector3d& eye, int most, Workers& workers) {
  const BoardSearch search(map, rules, points, half_side, eye);
  const std::vector<Eigen::Vector3d> normals = directions(map);
  std::vector<BoardPlace> found(normals.size());
  workers.for_each(normals.size(), [&](std::size_t i) { found[i] = search.best_facing(normals[i]); });
  std::erase_if(found, [](const BoardPlace& pose) { return pose.scale == 0; });

  const auto best_first = [&](std::vector<BoardPlace>& poses) {
    std::stable_sort(poses.begin(), poses.end(), [&](const BoardPlace& a, const BoardPlace& b) {
      return rules.worth(search.board(a)) > rules.worth(search.board(b));
    });
  };
  best_first(found);
  found.resize(std::min<std::size_t>(found.size(), normals.size() / 4));
  workers.for_each(found.size(), [&](std::size_t i) { found[i] = search.climbed(found[i]); });
  best_first(found);

  std::vector<Board> boards;
  for (const BoardPlace& pose : found) {
    const Board candidate = search.board(pose);
    const auto same = [&](const Board& other) {
      return candidate.plane.normal().dot(other.plane.normal()) > std::cos(kApart);
    };
    if (static_cast<int>(boards.size()) < most && std::none_of(boards.begin(), boards.end(), same))
      boards.push_back(candidate);
  }
  return boards;
}

}  // namespace hbr::inline robots
