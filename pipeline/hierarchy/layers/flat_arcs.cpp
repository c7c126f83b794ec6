#include "pipeline/hierarchy/layers/flat_arcs.h"

#include "pipeline/core/check.h"
#include "pipeline/hierarchy/layers/flat_model.h"

namespace hbr::inline hierarchy {

FlatArcEvaluator::FlatArcEvaluator(const Robot& robot, const Frame& frame, FlatStart start,
                                   ArcReading reading)
    : robot_(robot), frame_(frame), start_(start), reading_(reading) {}

template <class Measured>
void FlatArcEvaluator::measure(const Rows& genomes, Eigen::Index begin, Eigen::Index end, Seed seed,
                               Measured&& measured) const {
  constexpr int kStops = kArcSegments + 1;  // the start and five way-points
  const Eigen::Index dof = robot_.dof(), n = end - begin;
  std::vector<double> joints(n * kStops * dof);
  std::vector<Pen> pens(n * kStops);
  std::vector<float> start(dof, 0.5f);
  for (Eigen::Index i = 0; i < n; ++i) {
    const float* genome = genomes.row(begin + i).data();
    double* at = &joints[i * kStops * dof];
    if (start_ == FlatStart::kRandom) {
      Rng rng(seed.child(begin + i));
      for (float& gene : start) gene = rng.uniform();
    }
    decode_joints(robot_, start.data(), at);
    for (int w = 0; w < kArcSegments; ++w) decode_joints(robot_, genome + w * dof, at + (w + 1) * dof);
  }
  robot_.pens(n * kStops, joints.data(), pens.data());

  ArcPoints stops;
  for (Eigen::Index i = 0; i < n; ++i) {
    for (int k = 0; k < kStops; ++k) stops[k] = pens[i * kStops + k].position;
    const double* waypoints = &joints[(i * kStops + 1) * dof];
    double cost = 0;
    if (reading_.joint_term == JointTerm::kPooled)
      cost = joint_variance(waypoints, kArcSegments * dof);
    else
      for (int w = 0; w < kArcSegments; ++w) cost += joint_variance(waypoints + w * dof, dof) / kArcSegments;
    const std::span<const Eigen::Vector2d> drawn =
        std::span<const Eigen::Vector2d>(stops).subspan(start_ == FlatStart::kFirst ? 1 : 0);
    measured(begin + i, drawn, irregularity(drawn, reading_.turns), cost);
  }
}

void FlatArcEvaluator::evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed seed) const {
  measure(batch.genome, begin, end, seed,
          [&](Eigen::Index row, std::span<const Eigen::Vector2d> drawn, double irregular, double cost) {
            batch.descriptor.row(row) =
                arc_descriptor(frame_, arc_shape(drawn, reading_.centre)).cast<float>().transpose();
            batch.fitness[row] = static_cast<float>(-(irregular + cost));
            batch.valid[row] = 1;
          });
}

void FlatArcEvaluator::terms(const Rows& genomes, Eigen::Index begin, Eigen::Index end, Seed seed,
                             float* irregular_of, float* joint_of) const {
  measure(genomes, begin, end, seed,
          [&](Eigen::Index row, std::span<const Eigen::Vector2d>, double irregular, double cost) {
            irregular_of[row - begin] = static_cast<float>(irregular);
            joint_of[row - begin] = static_cast<float>(cost);
          });
}

const FlatArcEvaluator& flat_arc_evaluator(const LayerModel& layer) {
  const auto* evaluator = dynamic_cast<const FlatArcEvaluator*>(&layer.evaluator());
  if (!evaluator) throw InputError("the layer is of another kind; expected flat arcs");
  return *evaluator;
}

Coordinates configuration_coordinates(const Robot& robot) {
  Coordinates genes;
  for (int w = 1; w <= kArcSegments; ++w)
    append(genes, "configuration " + std::to_string(w) + " ", joint_coordinates(robot));
  return genes;
}

std::unique_ptr<LayerModel> make_flat_arcs(const FlatArcsSettings& settings, const Surroundings& around) {
  const FlatStart start = settings.start == "straight" ? FlatStart::kStraight
                          : settings.start == "first"  ? FlatStart::kFirst
                                                       : FlatStart::kRandom;
  FlatParts arcs;
  arcs.frame = {settings.half_side, settings.longest_line};
  arcs.genome = {configuration_coordinates(around.robot)};
  arcs.descriptor = arc_coordinates(arcs.frame);
  arcs.fitness = arc_fitness(arc_reading(settings));
  arcs.evaluator = std::make_unique<FlatArcEvaluator>(around.robot, arcs.frame, start, arc_reading(settings));
  return flat_model("flat arcs", std::move(arcs));
}

}  // namespace hbr::inline hierarchy
