// Whether a robot runs into its drawing board: coarse, with the capsules of its links.
#pragma once

#include <bitset>
#include <vector>

#include "models/robot/body/body.h"
#include "models/robot/body/capsules.h"
#include "models/robot/plane/drawing_plane.h"

namespace hbr::inline robots {

// The square of the arm's drawing area [-half_side, half_side]^2, m of the arm, on a robot's plane.
struct Board {
  DrawingPlane plane;
  double half_side;
};

// A set of directions in which a board may face: they are spread evenly, about 18 degrees apart.
constexpr int kDirections = 128;
using Directions = std::bitset<kDirections>;
Eigen::Vector3d direction(int i);  // unit
int nearest_direction(const Eigen::Vector3d& unit);

// The rule: no capsule of a link comes through the board or behind it, that is, within the square along its
// normal, however far behind, with the board's edges taken as square beams of the capsule's radius. Exempt is
// what holds the pen: capsules that move as one with the tip and have its origin within them (a hand about
// its pen's point).
class BoardCollision {
 public:
  BoardCollision(const Body& body, int tip);

  // Whether a link that moves breaks the rule. poses: of every link, Body::link_poses. Thread-safe.
  bool collides(const Board& board, const std::vector<Eigen::Isometry3d>& poses) const;

  // Whether a link that no moving joint moves does.
  bool pierced(const Board& board) const;

  // The normals of endless boards through the tip which no moving link breaks.
  Directions free(const std::vector<Eigen::Isometry3d>& poses) const;

  // The link that breaks such boards in the most directions, by index in the model; -1 where none does.
  int blocker(const std::vector<Eigen::Isometry3d>& poses) const;

 private:
  // In each direction, how far before the endless board through the tip all of the capsule is, m.
  static Eigen::Array<double, kDirections, 1> before_boards(const Capsule& placed,
                                                            const Eigen::Vector3d& tip);

  int tip_;
  std::vector<Capsule> moving_;
  std::vector<Capsule> still_;  // in the root link's frame
};

}  // namespace hbr::inline robots
