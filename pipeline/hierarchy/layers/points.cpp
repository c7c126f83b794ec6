#include "pipeline/hierarchy/layers/points.h"

#include <cmath>
#include <vector>

namespace hbr::inline hierarchy {

PointEvaluator::PointEvaluator(const Robot& robot, const Frame& frame, const JointCost& cost)
    : robot_(robot), frame_(frame), cost_(cost) {}

void PointEvaluator::evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed) const {
  const Eigen::Index dof = robot_.dof();
  std::vector<double> joints((end - begin) * dof);
  std::vector<Pen> pens(end - begin);
  for (Eigen::Index i = begin; i < end; ++i)
    decode_joints(robot_, batch.genome.row(i).data(), &joints[(i - begin) * dof]);
  robot_.pens(end - begin, joints.data(), pens.data());
  for (Eigen::Index i = begin; i < end; ++i) {
    const Pen& pen = pens[i - begin];
    const double* const q = &joints[(i - begin) * dof];
    const Eigen::Vector2d d = frame_.point_descriptor(pen.position);
    batch.valid[i] = std::abs(pen.off_plane) <= robot_.off_plane_tolerance() && (d.array() >= 0).all() &&
                     (d.array() <= 1).all() && robot_.clear(q, frame_.half_side);
    batch.descriptor.row(i) = d.cast<float>().transpose();
    batch.fitness[i] = static_cast<float>(-cost_.of(q, dof));
  }
}

namespace {

class PointsModel final : public LayerModel {
 public:
  PointsModel(const PointsSettings& settings, const Robot& robot)
      : robot_(robot),
        frame_{settings.half_side, 0},
        descriptor_(plane_coordinates("place", settings.half_side)),
        cost_(named(joint_costs(), settings.cost, "cost")),
        fitness_{std::string("minus ") + cost_.figure, "rad^2"},
        evaluator_(robot, frame_, cost_) {}
  GenomeShape genome() const override { return {joint_coordinates(robot_)}; }
  const Coordinates& descriptor() const override { return descriptor_; }
  const FitnessMeaning& fitness() const override { return fitness_; }
  const Evaluator& evaluator() const override { return evaluator_; }
  const Frame& frame() const override { return frame_; }
  std::unique_ptr<Layer> finished(const Elites& elites) const override {
    return std::make_unique<PointLayer>(elites, robot_, frame_);
  }

 private:
  const Robot& robot_;
  Frame frame_;
  Coordinates descriptor_;
  JointCost cost_;
  FitnessMeaning fitness_;
  PointEvaluator evaluator_;
};

}  // namespace

std::unique_ptr<LayerModel> make_points(const PointsSettings& settings, const Surroundings& around) {
  return std::make_unique<PointsModel>(settings, around.robot);
}

}  // namespace hbr::inline hierarchy
