// Which links of a robot move as one: links behind fixed or locked joints are parts of what they hang on.
#pragma once

#include <Eigen/Geometry>
#include <map>
#include <string>
#include <vector>

#include "models/robot/description/masses.h"
#include "models/robot/description/robot_model.h"

namespace hbr::inline robots {

// Links that move as one, in the frame of the link nearest to the root.
struct Part {
  int parent = -1;           // the part it hangs on; -1 for part 0, which holds the root and stands still
  int joint = -1;            // of the model; -1 for part 0
  Eigen::Isometry3d origin;  // of the joint, in the parent part's frame
  // Position of the joint: multiplier * coordinate + offset.
  int coordinate = -1;
  double multiplier = 1, offset = 0;

  double mass = 0;                                   // kg
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  // of mass
  // kg m^2, about the part's origin; the nearest that a body may have where there is a fault.
  Eigen::Matrix3d inertia_origin = Eigen::Matrix3d::Zero();
  MassFault fault = {};
};

struct Parts {
  struct Place {
    int part;
    Eigen::Isometry3d pose;  // of the link in the part's frame
  };
  std::vector<Part> parts;    // parents before children
  std::vector<Place> places;  // of each link
};

// See Body's constructor for the meaning and the errors.
Parts join_parts(const RobotModel& model, const std::vector<std::string>& moving,
                 const std::map<std::string, double>& rest);

}  // namespace hbr::inline robots
