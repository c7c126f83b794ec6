// Layer 3, arcs: five lines of layer 2 in a row.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "pipeline/hierarchy/arc_geometry.h"
#include "pipeline/hierarchy/line_layer.h"

namespace hbr {

using ArcLines = std::array<Eigen::Vector2d, kArcSegments>;  // displacements wanted of layer 2, m

// A controller decodes a genome into the five displacements.
struct ArcController {
  int genes;
  ArcLines (*decode)(const Frame&, const float* genes);
};
// "lines" (the paper's first controller): ten genes, five displacements in layer 2's range.
// "turn" (the second): heading in [-pi, pi], length of every segment in [0, rho], turn in [-pi, pi] between
// segments.
ArcController arc_controller(const std::string& name);

// The layer-1 elites at the six way-points of an arc executed through layers 2 and 1, and where their pens
// are.
using ArcWaypoints = std::array<std::int32_t, kArcSegments + 1>;
ArcPoints pen_positions(const PointLayer& points, const ArcWaypoints& waypoints);

// Mean over the five way-points after the start of a cost of the elites' joints, rad^2 (J with
// joint_variance).
double mean_joint_cost(const PointLayer& points, const ArcWaypoints& waypoints, JointCost cost);

// The finished layer.
class ArcLayer {
 public:
  ArcLayer(const Elites& elites, const Frame& frame, ArcController controller);
  Eigen::Index size() const { return table_.size(); }
  const ArcLines& lines(std::int32_t elite) const { return lines_[elite]; }
  // The elite nearest to a descriptor (C, Lambda) in [0, 1]^3.
  std::int32_t nearest(const Eigen::Vector3d& descriptor) const {
    const Eigen::Vector3f d = descriptor.cast<float>();
    return table_.nearest(d.data());
  }

 private:
  NearestTable<3> table_;
  std::vector<ArcLines> lines_;
};

// How J, the joints' part of the fitness, is taken over the five way-points after the start: the mean of
// their variances, or the variance of all their joints together.
enum class JointTerm { kMean, kPooled };

struct ArcReading {
  ArcCentre centre = ArcCentre::kCircle;
  JointTerm joint_term = JointTerm::kMean;
};
// "circle" or "centroid", "mean" or "pooled".
ArcReading arc_reading(const std::string& centre, const std::string& joint_term);

// An arc executed `samples` times from starts drawn uniformly among layer-1 elites.
struct ArcOutcome {
  Eigen::Vector3f descriptor;  // (C, Lambda) in [0, 1]^3: the geometric median of the executions
  float uncertainty;           // their mean distance to it
  ArcWaypoints waypoints;      // of the execution nearest to it
  double irregularity;         // of that one: the first two terms of the fitness, positive
  double joint_cost;           // J
  double fitness() const { return -(irregularity + joint_cost); }
};

// Genome -> stochastic descriptor and the fitness of the sample nearest to it: -(100 var |V_i| + var b_i +
// J).
class ArcEvaluator final : public Evaluator {
 public:
  ArcEvaluator(const PointLayer& points, const LineLayer& lines, const Frame& frame, ArcController controller,
               int samples, ArcReading reading = {});
  int descriptor_size() const override { return 3; }
  bool stochastic() const override { return true; }
  void evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed seed) const override;

  // Executes genomes [begin, end); row i draws its starts from seed.child(i).
  void execute(const Rows& genomes, Eigen::Index begin, Eigen::Index end, Seed seed, ArcOutcome* out) const;
  // Mean fitness of the executions of each genome.
  void mean_fitness(const Rows& genomes, Eigen::Index begin, Eigen::Index end, Seed seed, float* out) const;

 private:
  struct Runs;
  Runs& run(const Rows& genomes, Eigen::Index begin, Eigen::Index end, Seed seed) const;
  ArcOutcome outcome(const ArcWaypoints& waypoints) const;
  // Genomes whose executions fit into the nearest cache together.
  Eigen::Index block() const { return std::max(1, 512 / samples_); }

  const PointLayer& points_;
  const LineLayer& lines_;
  Frame frame_;
  ArcController controller_;
  int samples_;
  ArcReading reading_;
};

// Where the flat baseline's arc begins: at the straight arm (all joints at the middle of their range), at its
// own first configuration (four segments remain), or at a configuration drawn at random for every evaluation.
enum class FlatStart { kStraight, kFirst, kRandom };
// "straight", "first" or "random".
FlatStart flat_start(const std::string& name);

// The flat baseline (paper, section 5.4): five configurations of all joints.
class FlatArcEvaluator final : public Evaluator {
 public:
  FlatArcEvaluator(const Robot& robot, const Frame& frame, FlatStart start = FlatStart::kStraight,
                   ArcReading reading = {});
  int genes() const { return kArcSegments * static_cast<int>(robot_.dof()); }
  int descriptor_size() const override { return 3; }
  bool deterministic() const override { return start_ != FlatStart::kRandom; }
  void evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed seed) const override;

 private:
  const Robot& robot_;
  Frame frame_;
  FlatStart start_;
  ArcReading reading_;
};

}  // namespace hbr
