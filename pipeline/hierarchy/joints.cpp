#include "pipeline/hierarchy/joints.h"

#include <algorithm>
#include <array>
#include <utility>

namespace hbr::inline hierarchy {

void decode_joints(const Robot& robot, const float* genome, double* joints) {
  const Eigen::VectorXd &lower = robot.lower(), &upper = robot.upper();
  for (Eigen::Index j = 0; j < lower.size(); ++j) joints[j] = lower[j] + genome[j] * (upper[j] - lower[j]);
}

Coordinates joint_coordinates(const Robot& robot) {
  Coordinates joints;
  for (Eigen::Index j = 0; j < robot.dof(); ++j)
    joints.push_back({"joint " + std::to_string(j + 1), robot.unit(j), robot.lower()[j], robot.upper()[j]});
  return joints;
}

Eigen::VectorXf encode_joints(const Robot& robot, const Eigen::VectorXd& joints) {
  const Eigen::ArrayXd range = (robot.upper() - robot.lower()).array().max(1e-12);
  return ((joints - robot.lower()).array() / range).max(0).min(1).cast<float>();
}

double joint_variance(const double* joints, Eigen::Index dof) {
  double mean = 0, sum = 0;
  for (Eigen::Index j = 0; j < dof; ++j) mean += joints[j];
  mean /= static_cast<double>(dof);
  for (Eigen::Index j = 0; j < dof; ++j) sum += (joints[j] - mean) * (joints[j] - mean);
  return sum / static_cast<double>(dof);
}

double few_joints(const double* joints, Eigen::Index dof) {
  double sum = 0, largest = 0, second = 0;
  for (Eigen::Index j = 0; j < dof; ++j) {
    double square = joints[j] * joints[j];
    if (square > largest) std::swap(square, largest);
    if (square > second) std::swap(square, second);
    sum += square;
  }
  return sum;
}

std::span<const JointCost> joint_costs() {
  static constexpr std::array kCosts = {
      JointCost{"joint_variance", "that they differ", "the population variance of the joints", joint_variance,
                [](double limit, Eigen::Index) { return limit * limit; }},
      JointCost{"few_joints", "that more than two of them move",
                "the sum of the squares of all joints but the two largest", few_joints,
                [](double limit, Eigen::Index dof) {
                  return limit * limit * static_cast<double>(std::max<Eigen::Index>(dof - 2, 0));
                }},
  };
  return kCosts;
}

}  // namespace hbr::inline hierarchy
