// The ground under what stands on it: it pushes, it doesn't pull, and it does so where there is a sole.
#pragma once

#include <vector>

#include "models/robot/body/motion_tree.h"

namespace hbr::inline robots {

// The sole at rest: the convex hull of the places that touch the level floor.
class Support {
 public:
  // Places, m, in the root link's frame, whose z points up. Those no higher than `touching` above the
  // lowest touch the floor. Throws InputError where these have no area.
  Support(const std::vector<Eigen::Vector3d>& places, double touching);

  double floor() const { return floor_; }                                   // m
  const std::vector<Eigen::Vector2d>& corners() const { return corners_; }  // counter-clockwise, m

  // How far a place is inside the sole, m; below 0: outside.
  double margin(const Eigen::Vector2d& place) const;

  // The centre of pressure: the place on the floor about which the ground's reaction has no moment but one
  // about the vertical. The force must push up.
  Eigen::Vector2d centre_of_pressure(const Wrench& reaction) const;

  // The margin of the centre of pressure; minus infinity where the ground would have to pull.
  double margin(const Wrench& reaction) const;

 private:
  double floor_;
  std::vector<Eigen::Vector2d> corners_;
};

// The coefficient of friction below which the sole slips: the reaction's level part over its upright one;
// infinity where the ground would have to pull.
double needed_grip(const Wrench& reaction);

}  // namespace hbr::inline robots
