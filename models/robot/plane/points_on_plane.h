// Elites of a robot's layer of points, each exactly at its place on the plane.
#pragma once

#include <vector>

#include "models/robot/plane/robot_on_plane.h"
#include "pipeline/hierarchy/frame.h"
#include "pipeline/qd/elites.h"

namespace hbr::inline robots {

// Where an elite's descriptor [2] is, m, in the root link's frame.
Eigen::Vector3d place_of(const RobotOnPlane& robot, const Frame& frame, const Elites& elites,
                         Eigen::Index row);

// What an elite's genome does: sets its descriptor and its fitness, and gives its joints [dof].
Eigen::VectorXd perform_point(const RobotOnPlane& robot, const Frame& frame, Elites& elites,
                              Eigen::Index row);

// Projects an elite onto its place, with the joints as much alike as the place allows, and has it performed.
// One that would run into the robot or its board there keeps its joints.
Eigen::VectorXd project_point(const RobotOnPlane& robot, const Frame& frame, Elites& elites,
                              Eigen::Index row);

// How far joints bring the tip off the plane and from its place, m of the robot, and their variance, rad^2.
struct PointErrors {
  double off_plane, distance, variance;
};
PointErrors point_errors(const RobotOnPlane& robot, const Eigen::Vector3d& place,
                         const Eigen::VectorXd& joints);

}  // namespace hbr::inline robots
