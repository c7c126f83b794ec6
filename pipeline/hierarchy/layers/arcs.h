// Layer 3, arcs (paper, section 4.3): five lines of layer 2 in a row, regular and with joints that contribute
// alike.
#pragma once

#include "pipeline/hierarchy/drawing_settings.h"
#include "pipeline/hierarchy/execution_settings.h"
#include "pipeline/hierarchy/joints.h"
#include "pipeline/hierarchy/layers/arc_geometry.h"
#include "pipeline/hierarchy/stacked_model.h"
#include "pipeline/qd/named.h"

namespace hbr::inline hierarchy {

using ArcLines = std::array<Eigen::Vector2d, kArcSegments>;  // displacements wanted of layer 2, m

// A controller decodes a genome into the five displacements.
struct ArcController {
  const char* name;
  const char* meaning;
  Coordinates (*genes)(const Frame&);
  ArcLines (*decode)(const Frame&, const float* genes);
};
// "lines" (the paper's first controller): ten genes, five displacements in layer 2's range. "turn" (the
// second): heading in [-pi, pi], length of every segment in [0, rho], turn in [-pi, pi] between segments.
std::span<const ArcController> arc_controllers();

// What an arc's descriptor and fitness mean.
struct ArcReadingSettings {
  std::string centre;
  std::string joint_term;
  std::string turns = {}, still_heading = {};
};
template <class Fields>
void describe_arc_reading(Fields& f, ArcReadingSettings& s) {
  f.choice("centre", s.centre, {"circle", "centroid"}, "C: of the fitted circle, or the mean of the points");
  f.choice("joint_term", s.joint_term, {"mean", "pooled"},
           "J: mean of the way-points' joint variances, or the variance of all their joints together");
  f.choice("turns", s.turns, {"signed", "unsigned"}, "b: with the sense of the turns, or without");
  f.choice("still_heading", s.still_heading, {"zero", "kept"},
           "of a segment of no length: along the x-axis, or as the segment before");
}

struct ArcsSettings : ArcReadingSettings {
  std::string controller;
  int samples = 0;
  std::string sample_fitness = {}, way_points = {};
  StartSettings start = {};
};
template <class Fields>
void describe(Fields& f, ArcsSettings& s) {
  f.choice("controller", s.controller, names_of(arc_controllers()), meanings_of(arc_controllers()).c_str());
  describe_arc_reading(f, s);
  describe_samples(f, s.samples);
  describe_sample_fitness(f, s.sample_fitness);
  describe_way_points(f, s.way_points);
  describe_starts(f, s.start);
}

// How J, the joints' part of the fitness, is taken over the five way-points after the start: the mean of
// their variances, or the variance of all their joints together.
enum class JointTerm { kMean, kPooled };
struct ArcReading {
  ArcCentre centre = ArcCentre::kCircle;
  JointTerm joint_term = JointTerm::kMean;
  Turns turns = {};
};
ArcReading arc_reading(const ArcReadingSettings& settings);
FitnessMeaning arc_fitness(const ArcReading& reading);

class ArcDecoder final : public Decoder {
 public:
  ArcDecoder(const Frame& frame, const ArcController& controller) : frame_(frame), controller_(controller) {}
  int command_size() const override { return 2; }
  int max_commands() const override { return kArcSegments; }
  int decode(const float* genome, int length, double* commands) const override;

 private:
  Frame frame_;
  ArcController controller_;
};

// Descriptor (C, Lambda), fitness -(100 var |V_i| + var b_i + J).
class ArcOutcome final : public SampledOutcome {
 public:
  ArcOutcome(const Frame& frame, ArcReading reading) : frame_(frame), reading_(reading) {}
  int descriptor_size() const override { return 3; }
  void describe(const Executions& executions, int first, int n, float* const* descriptor) const override;
  double fitness(const Executions& executions, int execution) const override;

  ArcCentre centre() const { return reading_.centre; }
  // The terms of the fitness, positive: the first two, and J.
  double irregularity_of(const Executions& executions, int execution) const;
  double joint_cost(const Executions& executions, int execution) const;
  // Mean over the five way-points after the start of a cost of the elites' joints, rad^2.
  static double mean_joint_cost(const Executions& executions, int execution, const JointCost& cost);

 private:
  Frame frame_;
  ArcReading reading_;
};

// What a layer's arcs come to; throws InputError where the layer is of another kind.
const ArcOutcome& arc_outcome(const LayerModel& layer);

std::unique_ptr<LayerModel> make_arcs(const ArcsSettings& settings, const Surroundings& around);

}  // namespace hbr::inline hierarchy
