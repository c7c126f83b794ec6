// A body's parts and joints as Simbody has them, for programs that pose it without Simbody.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "models/robot/description/parts.h"

namespace hbr::inline robots {

// Links that move as one. Part 0 stands still, in the root link's frame. Another part's frame in its parent's
// is
//   origin * (a turn about `axis` by the position, or a shift along it)
// where the position of its joint is multiplier * coordinate + offset.
struct MovingPart {
  int parent = -1;  // before this one in the list
  bool slides = false;
  Eigen::Isometry3d origin = Eigen::Isometry3d::Identity();
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  // unit, in the part's frame
  int coordinate = -1;                              // among the body's joints
  double multiplier = 1, offset = 0;                // rad or m
};

struct MovingParts {
  std::vector<MovingPart> parts;
  std::vector<Parts::Place> places;  // of each link of the model
};

}  // namespace hbr::inline robots
