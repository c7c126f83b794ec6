#include "pipeline/hierarchy/point_layer.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "pipeline/core/check.h"

namespace hbr {

void decode_joints(const Robot& robot, const float* genome, double* joints) {
  const Eigen::VectorXd &lower = robot.lower(), &upper = robot.upper();
  for (Eigen::Index j = 0; j < lower.size(); ++j) joints[j] = lower[j] + genome[j] * (upper[j] - lower[j]);
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

JointCost joint_cost(const std::string& name) {
  if (name == "joint_variance") return joint_variance;
  if (name == "few_joints") return few_joints;
  throw InputError("joint cost '{}': expected joint_variance or few_joints", name);
}

namespace {
// How far lines may reach out of the drawing area, descriptor units: so much more the table covers.
float beyond(const Frame& frame) {
  return static_cast<float>(frame.longest_line / (2 * frame.half_side) + 0.05);
}
}  // namespace

PointLayer::PointLayer(const Elites& elites, const Robot& robot, const Frame& frame)
    : frame_(frame),
      table_(elites.measures, -beyond(frame), 1 + beyond(frame), 8),
      mean_(elites.size()),
      variance_(elites.size()) {
  position_.resize(elites.size(), 2);
  joints_.resize(elites.size(), robot.dof());
  for (Eigen::Index i = 0; i < elites.size(); ++i) {
    position_.row(i) = frame.point(elites.measures.row(i).transpose().cast<double>()).transpose();
    decode_joints(robot, elites.solution.row(i).data(), joints_.row(i).data());
    mean_[i] = joints_.row(i).mean();
    variance_[i] = joint_variance(joints_.row(i).data(), robot.dof());
  }
}

PointEvaluator::PointEvaluator(const Robot& robot, const Frame& frame, JointCost cost,
                               double off_plane_tolerance)
    : robot_(robot), frame_(frame), cost_(cost), tolerance_(off_plane_tolerance) {}

void PointEvaluator::evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed) const {
  const Eigen::Index dof = robot_.dof();
  std::vector<double> joints((end - begin) * dof);
  std::vector<Pen> pens(end - begin);
  for (Eigen::Index i = begin; i < end; ++i)
    decode_joints(robot_, batch.genome.row(i).data(), &joints[(i - begin) * dof]);
  robot_.pens(end - begin, joints.data(), pens.data());
  for (Eigen::Index i = begin; i < end; ++i) {
    const Pen& pen = pens[i - begin];
    const Eigen::Vector2d d = frame_.point_descriptor(pen.position);
    batch.valid[i] =
        std::abs(pen.off_plane) <= tolerance_ && (d.array() >= 0).all() && (d.array() <= 1).all();
    batch.descriptor.row(i) = d.cast<float>().transpose();
    batch.fitness[i] = static_cast<float>(-cost_(&joints[(i - begin) * dof], dof));
  }
}

}  // namespace hbr
