// Moves a robot's configuration exactly onto its drawing plane.
#pragma once

#include "models/robot/plane/robot_on_plane.h"

namespace hbr::inline robots {

// The configuration near `start` [dof] whose tip comes to `target` (m, the root link's frame) within the
// joints' limits, with as little variance about their mean as a chain with joints to spare allows: bounded
// least squares (Ceres, Levenberg-Marquardt) of the distance, in 0.1 mm, and of the joints' deviations from
// their mean, in rad. Where that ends farther from the target than it began, it is `start` again.
Eigen::VectorXd project_onto_plane(const RobotOnPlane& robot, const Eigen::Vector3d& target,
                                   const Eigen::VectorXd& start);

// What is minimised: residuals [3 + dof] and, where asked for, their derivative by the joints [3 + dof x
// dof].
Eigen::VectorXd projection_residuals(const RobotOnPlane& robot, const Eigen::Vector3d& target,
                                     const double* joints, Eigen::MatrixXd* jacobian = nullptr);

}  // namespace hbr::inline robots
