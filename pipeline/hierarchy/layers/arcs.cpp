#include "pipeline/hierarchy/layers/arcs.h"

#include <cmath>
#include <numbers>

#include "pipeline/core/check.h"
#include "pipeline/hierarchy/layers/lines.h"
#include "pipeline/hierarchy/stack.h"

namespace hbr::inline hierarchy {
namespace {

ArcLines decode_lines(const Frame& frame, const float* genes) {
  ArcLines lines;
  for (int i = 0; i < kArcSegments; ++i) lines[i] = decode_line(frame, genes + 2 * i);
  return lines;
}

Coordinates line_genes(const Frame& frame) {
  Coordinates genes;
  for (int i = 1; i <= kArcSegments; ++i)
    append(genes, "line " + std::to_string(i) + " ", line_coordinates(frame));
  return genes;
}

Coordinates turn_genes(const Frame& frame) {
  constexpr double kPi = std::numbers::pi;
  return {{"heading", "rad", -kPi, kPi},
          {"length of a line", "m", 0, frame.longest_line},
          {"turn", "rad", -kPi, kPi}};
}

ArcLines decode_turn(const Frame& frame, const float* genes) {
  const double heading = (2.0 * genes[0] - 1) * std::numbers::pi,
               turn = (2.0 * genes[2] - 1) * std::numbers::pi;
  const double length = genes[1] * frame.longest_line;
  // Written out: Eigen's rotations take fused multiply-adds where there are any, which gives other bytes.
  const double cosine = std::cos(turn), sine = std::sin(turn);
  ArcLines lines;
  lines[0] = length * Eigen::Vector2d(std::cos(heading), std::sin(heading));
  for (int i = 1; i < kArcSegments; ++i) {
    const Eigen::Vector2d& last = lines[i - 1];
    lines[i] = {cosine * last.x() - sine * last.y(), sine * last.x() + cosine * last.y()};
  }
  return lines;
}

}  // namespace

std::span<const ArcController> arc_controllers() {
  static constexpr std::array kControllers = {
      ArcController{"lines", "ten genes, five displacements", line_genes, decode_lines},
      ArcController{"turn", "three genes, heading, length and turn", turn_genes, decode_turn},
  };
  return kControllers;
}

ArcReading arc_reading(const ArcReadingSettings& settings) {
  return {settings.centre == "centroid" ? ArcCentre::kCentroid : ArcCentre::kCircle,
          settings.joint_term == "pooled" ? JointTerm::kPooled : JointTerm::kMean,
          {settings.turns == "unsigned", settings.still_heading == "kept"}};
}

FitnessMeaning arc_fitness(const ArcReading& reading) {
  return {std::string("minus the sum of 100 times the variance of the lines' lengths (m^2), the variance of "
                      "the turns between them (rad^2") +
              (reading.turns.without_sense ? ", without their sense" : "") + ") and " +
              (reading.joint_term == JointTerm::kMean
                   ? "the mean over the way-points of the variance of their joints (rad^2)"
                   : "the variance of all joints of all way-points (rad^2)"),
          ""};
}

int ArcDecoder::decode(const float* genome, int /*length*/, double* commands) const {
  for (const Eigen::Vector2d& line : controller_.decode(frame_, genome)) {
    const Eigen::Vector2d wanted = frame_.line_descriptor(line);
    *commands++ = wanted.x();
    *commands++ = wanted.y();
  }
  return kArcSegments;
}

void ArcOutcome::describe(const Executions& executions, int first, int n, float* const* descriptor) const {
  thread_local ArcTracks tracks;
  if (static_cast<int>(tracks.x[0].size()) != n) tracks.resize(n);
  const PointLayer& points = executions.points();
  for (int k = 0; k <= kArcSegments; ++k) {
    const std::int32_t* stop = executions.stop(k) + first;
    for (int i = 0; i < n; ++i) {
      const float* place = points.descriptor(stop[i]);
      tracks.x[k][i] = place[0];
      tracks.y[k][i] = place[1];
    }
  }
  arc_descriptors(frame_, reading_.centre, tracks, n, descriptor);
}

double ArcOutcome::irregularity_of(const Executions& executions, int execution) const {
  ArcPoints positions;
  for (int k = 0; k <= kArcSegments; ++k)
    positions[k] = executions.points().position(executions.stop(k)[execution]);
  return irregularity(positions, reading_.turns);
}

double ArcOutcome::joint_cost(const Executions& executions, int execution) const {
  const PointLayer& points = executions.points();
  double cost = 0, mean = 0, square = 0;
  for (int k = 1; k <= kArcSegments; ++k) {
    const std::int32_t at = executions.stop(k)[execution];
    cost += points.variance(at) / kArcSegments;
    mean += points.mean(at) / kArcSegments;
    square += points.mean(at) * points.mean(at) / kArcSegments;
  }
  // Together they vary as each on its own, and as their means among each other.
  if (reading_.joint_term == JointTerm::kPooled) cost += square - mean * mean;
  return cost;
}

double ArcOutcome::mean_joint_cost(const Executions& executions, int execution, const JointCost& cost) {
  const PointLayer& points = executions.points();
  double sum = 0;
  for (int k = 1; k <= kArcSegments; ++k)
    sum += cost.of(points.joints(executions.stop(k)[execution]), points.dof());
  return sum / kArcSegments;
}

double ArcOutcome::fitness(const Executions& executions, int execution) const {
  return -(irregularity_of(executions, execution) + joint_cost(executions, execution));
}

const ArcOutcome& arc_outcome(const LayerModel& layer) {
  const auto* outcome = dynamic_cast<const ArcOutcome*>(layer.sampled_outcome());
  if (!outcome) throw InputError("the layer is of another kind; expected arcs");
  return *outcome;
}

std::unique_ptr<LayerModel> make_arcs(const ArcsSettings& settings, const Surroundings& around) {
  const ArcController& controller = named(arc_controllers(), settings.controller, "controller");
  StackedParts arcs;
  arcs.frame = around.below->frame();
  arcs.genome = {controller.genes(arcs.frame)};
  arcs.descriptor = arc_coordinates(arcs.frame);
  arcs.fitness = arc_fitness(arc_reading(settings));
  arcs.decoder = std::make_unique<ArcDecoder>(arcs.frame, controller);
  arcs.sampled = std::make_unique<ArcOutcome>(arcs.frame, arc_reading(settings));
  arcs.samples = settings.samples;
  arcs.sample_fitness = sample_fitness_of(settings.sample_fitness);
  arcs.starts = settings.start.of(around.robot);
  arcs.way.points = way_points_of(settings.way_points);
  return stacked_model(around, std::move(arcs));
}

}  // namespace hbr::inline hierarchy
