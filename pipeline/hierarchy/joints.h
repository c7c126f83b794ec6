// Joint angles: from genes and back, and what they cost.
#pragma once

#include <span>
#include <vector>

#include "pipeline/hierarchy/coordinate.h"
#include "pipeline/hierarchy/robot.h"

namespace hbr::inline hierarchy {

// Joints [dof] of a genome [dof] in [0, 1]: the range of the limits.
void decode_joints(const Robot& robot, const float* genome, double* joints);
// What its genes are.
Coordinates joint_coordinates(const Robot& robot);
// The genome [dof] of joints [dof]; beyond the limits it is theirs.
Eigen::VectorXf encode_joints(const Robot& robot, const Eigen::VectorXd& joints);

// Population variance of the joints, rad^2 (paper, section 4.3, the fitness of layer 1, to be minimised).
double joint_variance(const double* joints, Eigen::Index dof);
// Sum of the squares of all joints but the two largest, rad^2 (paper, section 5.2, the substitute's fitness).
double few_joints(const double* joints, Eigen::Index dof);

struct JointCost {
  const char* name;
  const char* meaning;
  const char* figure;  // what it is, in rad^2
  double (*of)(const double* joints, Eigen::Index dof);
  double (*most)(double limit, Eigen::Index dof);  // of joints within [-limit, limit], none costs more
};
std::span<const JointCost> joint_costs();

}  // namespace hbr::inline hierarchy
