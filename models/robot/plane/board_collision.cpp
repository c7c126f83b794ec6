#include "models/robot/plane/board_collision.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace hbr::inline robots {
namespace {

using Lattice = Eigen::Matrix<double, kDirections, 3>;

// Fibonacci's.
Lattice lattice() {
  Lattice result;
  for (int i = 0; i < kDirections; ++i) {
    const double z = 1 - (2 * i + 1.) / kDirections, turn = 2 * std::numbers::pi * i / std::numbers::phi;
    const double level = std::sqrt(1 - z * z);
    result.row(i) << level * std::cos(turn), level * std::sin(turn), z;
  }
  return result;
}
const Lattice kLattice = lattice();

// The part of the capsule's segment that is less than its radius before the board and less than that beside
// it.
bool breaks(const Board& board, const Capsule& capsule) {
  const DrawingPlane& plane = board.plane;
  const double beside = plane.scale * board.half_side + capsule.radius;
  const Eigen::Vector3d away = capsule.middle - plane.origin;
  double from = -1, to = 1;
  const auto clip = [&](const Eigen::Vector3d& axis, double limit) {
    const double middle = axis.dot(away), slope = axis.dot(capsule.half);
    if (slope > 0) to = std::min(to, (limit - middle) / slope);
    if (slope < 0) from = std::max(from, (limit - middle) / slope);
    return slope != 0 || middle < limit;
  };
  return clip(plane.normal(), capsule.radius) && clip(plane.u, beside) && clip(-plane.u, beside) &&
         clip(plane.v, beside) && clip(-plane.v, beside) && from < to;
}

}  // namespace

Eigen::Vector3d direction(int i) { return kLattice.row(i); }

int nearest_direction(const Eigen::Vector3d& unit) {
  int nearest = 0;
  (kLattice * unit).maxCoeff(&nearest);
  return nearest;
}

BoardCollision::BoardCollision(const Body& body, int tip) : tip_(tip) {
  const std::vector<Eigen::Isometry3d> poses =
      body.link_poses(body.lower().cwiseMax(0).cwiseMin(body.upper()));
  const Capsule pen{tip, poses[tip].translation(), Eigen::Vector3d::Zero(), 0};
  for (std::size_t i = 0; i < body.model().links.size(); ++i) {
    const int link = static_cast<int>(i);
    const std::vector<bool> moved_by = body.moves(link);
    for (Capsule capsule : capsules_of(body.model(), link)) {
      const Capsule placed = capsule.at(poses[i]);
      if (std::ranges::count(moved_by, true) == 0)
        still_.push_back(placed);
      else if (moved_by != body.moves(tip) || squared_distance(placed, pen) > capsule.radius * capsule.radius)
        moving_.push_back(capsule);
    }
  }
}

bool BoardCollision::collides(const Board& board, const std::vector<Eigen::Isometry3d>& poses) const {
  return std::ranges::any_of(
      moving_, [&](const Capsule& capsule) { return breaks(board, capsule.at(poses[capsule.link])); });
}

bool BoardCollision::pierced(const Board& board) const {
  return std::ranges::any_of(still_, [&](const Capsule& capsule) { return breaks(board, capsule); });
}

Eigen::Array<double, kDirections, 1> BoardCollision::before_boards(const Capsule& placed,
                                                                   const Eigen::Vector3d& tip) {
  return (kLattice * (placed.middle - tip)).array() - (kLattice * placed.half).array().abs() - placed.radius;
}

int BoardCollision::blocker(const std::vector<Eigen::Isometry3d>& poses) const {
  std::map<int, Eigen::Index> blocked;  // by link
  for (const Capsule& capsule : moving_)
    blocked[capsule.link] +=
        (before_boards(capsule.at(poses[capsule.link]), poses[tip_].translation()) < 0).count();
  const auto most = std::ranges::max_element(blocked, {}, [](const auto& link) { return link.second; });
  return most == blocked.end() || most->second == 0 ? -1 : most->first;
}

Directions BoardCollision::free(const std::vector<Eigen::Isometry3d>& poses) const {
  Eigen::Array<double, kDirections, 1> least = Eigen::Array<double, kDirections, 1>::Ones();
  for (const Capsule& capsule : moving_)
    least = least.min(before_boards(capsule.at(poses[capsule.link]), poses[tip_].translation()));
  Directions result;
  for (int i = 0; i < kDirections; ++i) result[i] = least[i] >= 0;
  return result;
}

}  // namespace hbr::inline robots
