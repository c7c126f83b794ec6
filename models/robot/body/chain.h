// Kinematic chains of a robot, for questions about many postures that need no masses.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <utility>
#include <vector>

#include "models/robot/description/robot_model.h"

namespace hbr::inline robots {

// The joints that move a link without children.
struct Chain {
  struct Step {
    Eigen::Isometry3d before;  // of the joint's parent link, in the frame of what the step before moves
    const Joint* joint;        // stands at multiplier * coordinate + offset
    int coordinate;
  };
  std::string link;
  std::vector<Step> steps;            // from the root on, whose frame the first is in; at least one
  Eigen::Vector3d tip;                // the link's origin in the frame of what the last step moves
  std::vector<const Joint*> leaders;  // of each coordinate: the joint by itself that it is the position of
  std::vector<std::pair<double, double>> ranges;  // of these (RobotModel::range)

  // Where what a step moves stands in the frame of the step before.
  static Eigen::Isometry3d motion(const Step& step, const std::vector<double>& coordinates) {
    return step.before *
           step.joint->motion(step.joint->multiplier * coordinates[step.coordinate] + step.joint->offset);
  }
  // The tip in the root link's frame. coordinates [leaders.size()]
  Eigen::Vector3d tip_at(const std::vector<double>& coordinates) const;
  // The first joint, where all of the chain turns about, in the root link's frame.
  Eigen::Vector3d base() const { return (steps[0].before * steps[0].joint->origin).translation(); }
};

// Of every link without children that a joint moves, in the order of the links. They point into the model.
std::vector<Chain> chains_of(const RobotModel& model);

// How far the tip can get from the base within the limits, m. By climbing from the posture 0 and from some at
// random: never more than what is possible, and rarely less.
double farthest_reach(const Chain& chain, int starts = 30);

// The tip in n postures at random within the limits, every coordinate evenly; in the root link's frame.
std::vector<Eigen::Vector3d> reached_points(const Chain& chain, int n);

}  // namespace hbr::inline robots
