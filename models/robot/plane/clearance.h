// What a robot that draws keeps clear of: itself and its board.
#pragma once

#include <optional>

#include "models/robot/body/self_collision.h"
#include "models/robot/plane/board_collision.h"

namespace hbr::inline robots {

class Clearance {
 public:
  // `body` must outlive it.
  Clearance(const Body& body, int tip) : body_(body), self_(body), board_(body, tip) {}

  // Whether the configuration [dof] runs neither into itself nor into the board. Thread-safe.
  bool clear(const double* joints, const Board& board) const {
    const std::vector<Eigen::Isometry3d> poses = posed(joints);
    return !board_.collides(board, poses) && !self_.collides(poses);
  }

  // The directions (board_collision.h) in which a board may face that the tip touches: none where the robot
  // runs into itself.
  Directions free(const double* joints) const {
    const std::vector<Eigen::Isometry3d> poses = posed(joints);
    return self_.collides(poses) ? Directions() : board_.free(poses);
  }

  // The link that keeps the most boards from the tip (BoardCollision::blocker); nothing where the robot runs
  // into itself.
  std::optional<int> blocker(const double* joints) const {
    const std::vector<Eigen::Isometry3d> poses = posed(joints);
    return self_.collides(poses) ? std::nullopt : std::optional(board_.blocker(poses));
  }

  // Whether what never moves stands in the board.
  bool pierced(const Board& board) const { return board_.pierced(board); }

 private:
  std::vector<Eigen::Isometry3d> posed(const double* joints) const {
    return body_.link_poses(Eigen::Map<const Eigen::VectorXd>(joints, body_.dof()));
  }

  const Body& body_;
  SelfCollision self_;
  BoardCollision board_;
};

}  // namespace hbr::inline robots
