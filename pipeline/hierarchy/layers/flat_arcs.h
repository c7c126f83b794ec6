// The flat baseline of section 5.4: arcs by five configurations of all joints, without a hierarchy.
#pragma once

#include "pipeline/hierarchy/layers/arcs.h"

namespace hbr::inline hierarchy {

struct FlatArcsSettings : ArcReadingSettings {
  double half_side = 0, longest_line = 0;
  std::string start;
};
template <class Fields>
void describe(Fields& f, FlatArcsSettings& s) {
  describe_half_side(f, s.half_side);
  describe_longest_line(f, s.longest_line);
  describe_arc_reading(f, s);
  f.choice("start", s.start, {"straight", "first", "random"},
           "of the arc: the straight arm, its own first configuration, or one drawn at random");
}

// Where the arc begins: at the straight arm (all joints at the middle of their range), at its own first
// configuration (four segments remain), or at a configuration drawn at random for every evaluation.
enum class FlatStart { kStraight, kFirst, kRandom };

class FlatArcEvaluator final : public Evaluator {
 public:
  FlatArcEvaluator(const Robot& robot, const Frame& frame, FlatStart start = FlatStart::kStraight,
                   ArcReading reading = {});
  int genes() const { return kArcSegments * static_cast<int>(robot_.dof()); }
  int descriptor_size() const override { return 3; }
  bool deterministic() const override { return start_ != FlatStart::kRandom; }
  void evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed seed) const override;
  // The terms of the fitness of rows [begin, end), positive: irregularity, and J.
  void terms(const Rows& genomes, Eigen::Index begin, Eigen::Index end, Seed seed, float* irregular,
             float* joint) const;

 private:
  // measured(row, the points drawn, their irregularity, J)
  template <class Measured>
  void measure(const Rows& genomes, Eigen::Index begin, Eigen::Index end, Seed seed,
               Measured&& measured) const;

  const Robot& robot_;
  Frame frame_;
  FlatStart start_;
  ArcReading reading_;
};

// The genes of five configurations of all joints.
Coordinates configuration_coordinates(const Robot& robot);

// Throws InputError where the layer is of another kind.
const FlatArcEvaluator& flat_arc_evaluator(const LayerModel& layer);

std::unique_ptr<LayerModel> make_flat_arcs(const FlatArcsSettings& settings, const Surroundings& around);

}  // namespace hbr::inline hierarchy
