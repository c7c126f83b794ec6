// The lowest layer, points: the finished repertoire through which everything above moves the pen.
#pragma once

#include <array>

#include "pipeline/hierarchy/frame.h"
#include "pipeline/hierarchy/layer.h"
#include "pipeline/hierarchy/robot.h"
#include "pipeline/qd/nearest_table.h"

namespace hbr::inline hierarchy {

class PointLayer final : public Layer {
 public:
  PointLayer(const Elites& elites, const Robot& robot, const Frame& frame);

  Eigen::Index size() const override { return position_.rows(); }
  int command_size() const override { return 2; }
  void nearest(int n, const float* const* commands, std::int32_t* elites) const override {
    table_.nearest(n, {commands[0], commands[1]}, elites);
  }
  void perform(Executions& executions, Group group, const std::int32_t* elites, int repeat) const override;

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
    return table_.nearest(descriptor.data());
  }

  // In the layer's own units: an elite's descriptor [2], and the elites nearest to n of them.
  const float* descriptor(std::int32_t elite) const { return table_.point(elite); }
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

}  // namespace hbr::inline hierarchy
