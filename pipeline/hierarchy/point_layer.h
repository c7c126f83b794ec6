// Layer 1, points: the finished repertoire through which everything above moves the pen, and what it is
// evolved for.
#pragma once

#include <array>
#include <string>

#include "pipeline/hierarchy/frame.h"
#include "pipeline/hierarchy/robot.h"
#include "pipeline/qd/evaluator.h"
#include "pipeline/qd/nearest_table.h"

namespace hbr {

// Joints [dof] of a genome [dof] in [0, 1]: the range of the limits.
void decode_joints(const Robot& robot, const float* genome, double* joints);

// Population variance of the joints, rad^2 (paper, section 4.3, the fitness of layer 1, to be minimised).
double joint_variance(const double* joints, Eigen::Index dof);
// Sum of the squares of all joints but the two largest, rad^2 (paper, section 5.2, the substitute's fitness).
double few_joints(const double* joints, Eigen::Index dof);

using JointCost = double (*)(const double* joints, Eigen::Index dof);
// "joint_variance" or "few_joints".
JointCost joint_cost(const std::string& name);

// The finished layer.
class PointLayer {
 public:
  PointLayer(const Elites& elites, const Robot& robot, const Frame& frame);

  Eigen::Index size() const { return position_.rows(); }
  Eigen::Index dof() const { return joints_.cols(); }
  // Pen of an elite, m.
  Eigen::Vector2d position(std::int32_t elite) const { return position_.row(elite).transpose(); }
  const double* joints(std::int32_t elite) const { return joints_.row(elite).data(); }
  // Mean and variance of its joints, rad and rad^2.
  double mean(std::int32_t elite) const { return mean_[elite]; }
  double variance(std::int32_t elite) const { return variance_[elite]; }
  // The elite whose pen is nearest to a place [m].
  std::int32_t nearest(const Eigen::Vector2d& place) const {
    const Eigen::Vector2f descriptor = frame_.point_descriptor(place).cast<float>();
    return nearest(descriptor.data());
  }

  // In the layer's own units: an elite's descriptor [2], and the elite nearest to one or to each of n.
  const float* descriptor(std::int32_t elite) const { return table_.point(elite); }
  std::int32_t nearest(const float* descriptor) const { return table_.nearest(descriptor); }
  void nearest(int n, const std::array<const float*, 2>& descriptors, std::int32_t* found) const {
    table_.nearest(n, descriptors, found);
  }
  const Frame& frame() const { return frame_; }

 private:
  using RowsD = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Frame frame_;
  NearestTable<2> table_;
  RowsD position_, joints_;
  Eigen::VectorXd mean_, variance_;
};

// Genome [dof] -> descriptor (P + L) / 2L, fitness minus the cost of the joints. No behaviour outside the
// drawing area or farther from the drawing plane than the tolerance [m].
class PointEvaluator final : public Evaluator {
 public:
  PointEvaluator(const Robot& robot, const Frame& frame, JointCost cost, double off_plane_tolerance);
  int descriptor_size() const override { return 2; }
  bool deterministic() const override { return true; }
  void evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed seed) const override;

 private:
  const Robot& robot_;
  Frame frame_;
  JointCost cost_;
  double tolerance_;
};

}  // namespace hbr
