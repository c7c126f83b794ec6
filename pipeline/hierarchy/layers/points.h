// Layer 1, points (paper, section 4.3): every place that the pen can reach, by the joint angles that bring it
// there.
#pragma once

#include "pipeline/hierarchy/drawing_settings.h"
#include "pipeline/hierarchy/joints.h"
#include "pipeline/hierarchy/layer_model.h"
#include "pipeline/qd/named.h"

namespace hbr::inline hierarchy {

struct PointsSettings {
  double half_side = 0;
  std::string cost;
};
template <class Fields>
void describe(Fields& f, PointsSettings& s) {
  describe_half_side(f, s.half_side);
  f.choice("cost", s.cost, names_of(joint_costs()),
           ("what it minimises: " + meanings_of(joint_costs())).c_str());
}

// Genome [dof] -> descriptor (P + L) / 2L, fitness minus the cost of the joints. No behaviour outside the
// drawing area, farther from the drawing plane than the robot's tolerance, or where the robot is not clear.
class PointEvaluator final : public Evaluator {
 public:
  PointEvaluator(const Robot& robot, const Frame& frame, const JointCost& cost);
  int descriptor_size() const override { return 2; }
  bool deterministic() const override { return true; }
  void evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed seed) const override;

 private:
  const Robot& robot_;
  Frame frame_;
  JointCost cost_;
};

std::unique_ptr<LayerModel> make_points(const PointsSettings& settings, const Surroundings& around);

}  // namespace hbr::inline hierarchy
