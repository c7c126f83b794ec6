// Whether a robot runs into itself: coarse, with a few capsules around each link.
#pragma once

#include <vector>

#include "models/robot/body/body.h"
#include "models/robot/body/capsules.h"

namespace hbr::inline robots {

class SelfCollision {
 public:
  // Never in each other's way are links that move as one, that a joint connects, or whose capsules touch at
  // rest (the moving joints at 0, or at the limit next to it).
  explicit SelfCollision(const Body& body);

  // poses: of every link, Body::link_poses. Thread-safe.
  bool collides(const std::vector<Eigen::Isometry3d>& poses) const;

 private:
  struct Pair {
    int a, b;  // capsules
  };

  std::vector<Capsule> capsules_;
  std::vector<Pair> pairs_;
};

}  // namespace hbr::inline robots
