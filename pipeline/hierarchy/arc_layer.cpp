#include "pipeline/hierarchy/arc_layer.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <vector>

#include "pipeline/core/check.h"
#include "pipeline/hierarchy/geometric_median.h"

namespace hbr {
namespace {

ArcLines decode_lines(const Frame& frame, const float* genes) {
  ArcLines lines;
  for (int i = 0; i < kArcSegments; ++i) lines[i] = decode_line(frame, genes + 2 * i);
  return lines;
}

ArcLines decode_turn(const Frame& frame, const float* genes) {
  const double heading = (2.0 * genes[0] - 1) * std::numbers::pi,
               turn = (2.0 * genes[2] - 1) * std::numbers::pi;
  const double length = genes[1] * frame.longest_line;
  ArcLines lines;
  lines[0] = length * Eigen::Vector2d(std::cos(heading), std::sin(heading));
  const Eigen::Matrix2d rotation = Eigen::Rotation2Dd(turn).toRotationMatrix();
  for (int i = 1; i < kArcSegments; ++i) lines[i] = rotation * lines[i - 1];
  return lines;
}

}  // namespace

ArcController arc_controller(const std::string& name) {
  if (name == "lines") return {2 * kArcSegments, decode_lines};
  if (name == "turn") return {3, decode_turn};
  throw InputError("arc controller '{}': expected lines or turn", name);
}

ArcPoints pen_positions(const PointLayer& points, const ArcWaypoints& waypoints) {
  ArcPoints positions;
  for (std::size_t i = 0; i < waypoints.size(); ++i) positions[i] = points.position(waypoints[i]);
  return positions;
}

double mean_joint_cost(const PointLayer& points, const ArcWaypoints& waypoints, JointCost cost) {
  double sum = 0;
  for (int i = 1; i <= kArcSegments; ++i) sum += cost(points.joints(waypoints[i]), points.dof());
  return sum / kArcSegments;
}

ArcLayer::ArcLayer(const Elites& elites, const Frame& frame, ArcController controller)
    : table_(elites.measures, 0.0f, 1.0001f, 6) {
  for (Eigen::Index i = 0; i < elites.size(); ++i)
    lines_.push_back(controller.decode(frame, elites.solution.row(i).data()));
}

ArcReading arc_reading(const std::string& centre, const std::string& joint_term) {
  ArcReading reading;
  if (centre == "centroid")
    reading.centre = ArcCentre::kCentroid;
  else if (centre != "circle")
    throw InputError("centre '{}': expected circle or centroid", centre);
  if (joint_term == "pooled")
    reading.joint_term = JointTerm::kPooled;
  else if (joint_term != "mean")
    throw InputError("joint_term '{}': expected mean or pooled", joint_term);
  return reading;
}

ArcEvaluator::ArcEvaluator(const PointLayer& points, const LineLayer& lines, const Frame& frame,
                           ArcController controller, int samples, ArcReading reading)
    : points_(points),
      lines_(lines),
      frame_(frame),
      controller_(controller),
      samples_(samples),
      reading_(reading) {}

// Executions of a block of genomes, one after the other; all take the same step together, so that their
// look-ups do not wait for each other.
struct ArcEvaluator::Runs {
  std::array<std::vector<std::int32_t>, kArcSegments + 1> elite;
  ArcTracks tracks;
  Samples<3> descriptors;
  std::vector<float> wanted[2], request[2], step[2];

  ArcWaypoints waypoints(int execution) const {
    ArcWaypoints out;
    for (std::size_t k = 0; k < out.size(); ++k) out[k] = elite[k][execution];
    return out;
  }
};

ArcEvaluator::Runs& ArcEvaluator::run(const Rows& genomes, Eigen::Index begin, Eigen::Index end,
                                      Seed seed) const {
  thread_local Runs runs;
  const auto n = static_cast<int>(end - begin), executions = n * samples_;
  runs.tracks.resize(executions);
  for (auto& elites : runs.elite) elites.resize(executions);
  for (int d = 0; d < 2; ++d) {
    runs.wanted[d].resize(n * kArcSegments);
    runs.request[d].resize(n * kArcSegments);
    runs.step[d].resize(executions);
  }

  // A line asks the same of layer 1 wherever it starts, so layer 2 is asked once.
  for (int i = 0; i < n; ++i) {
    const ArcLines lines = controller_.decode(frame_, genomes.row(begin + i).data());
    for (int k = 0; k < kArcSegments; ++k) {
      const Eigen::Vector2f wanted = frame_.line_descriptor(lines[k]).cast<float>();
      for (int d = 0; d < 2; ++d) runs.wanted[d][k * n + i] = wanted[d];
    }
  }
  lines_.requests(n * kArcSegments, {runs.wanted[0].data(), runs.wanted[1].data()}, runs.request[0].data(),
                  runs.request[1].data());

  const auto elites = static_cast<std::uint32_t>(points_.size());
  for (int i = 0; i < n; ++i) {
    Rng rng(seed.child(begin + i));
    for (int s = 0; s < samples_; ++s)
      runs.elite[0][i * samples_ + s] = static_cast<std::int32_t>(rng.below(elites));
  }
  for (int k = 0; k <= kArcSegments; ++k) {
    if (k > 0) {
      for (int d = 0; d < 2; ++d)
        for (int i = 0; i < n; ++i)
          std::fill_n(&runs.step[d][i * samples_], samples_, runs.request[d][(k - 1) * n + i]);
      line_ends(points_, executions, runs.elite[k - 1].data(), runs.step[0].data(), runs.step[1].data(),
                runs.elite[k].data());
    }
    for (int e = 0; e < executions; ++e) {
      const float* place = points_.descriptor(runs.elite[k][e]);
      runs.tracks.x[k][e] = place[0];
      runs.tracks.y[k][e] = place[1];
    }
  }
  return runs;
}

ArcOutcome ArcEvaluator::outcome(const ArcWaypoints& waypoints) const {
  ArcOutcome outcome{{}, 0, waypoints, irregularity(pen_positions(points_, waypoints)), 0};
  double mean = 0, square = 0;
  for (int k = 1; k <= kArcSegments; ++k) {
    outcome.joint_cost += points_.variance(waypoints[k]) / kArcSegments;
    mean += points_.mean(waypoints[k]) / kArcSegments;
    square += points_.mean(waypoints[k]) * points_.mean(waypoints[k]) / kArcSegments;
  }
  // Together they vary as each on its own, and as their means among each other.
  if (reading_.joint_term == JointTerm::kPooled) outcome.joint_cost += square - mean * mean;
  return outcome;
}

void ArcEvaluator::execute(const Rows& genomes, Eigen::Index begin, Eigen::Index end, Seed seed,
                           ArcOutcome* out) const {
  for (Eigen::Index first = begin; first < end; first += block()) {
    const Eigen::Index last = std::min(end, first + block());
    Runs& runs = run(genomes, first, last, seed);
    runs.descriptors.resize(samples_);
    for (Eigen::Index i = first; i < last; ++i) {
      const auto execution = static_cast<int>(i - first) * samples_;
      arc_descriptors(frame_, reading_.centre, runs.tracks, execution, runs.descriptors);
      const Median<3> median = geometric_median<3>(runs.descriptors);
      ArcOutcome& o = out[i - begin] = outcome(runs.waypoints(execution + median.nearest));
      o.descriptor = median.point;
      o.uncertainty = median.mean_distance;
    }
  }
}

void ArcEvaluator::mean_fitness(const Rows& genomes, Eigen::Index begin, Eigen::Index end, Seed seed,
                                float* out) const {
  for (Eigen::Index first = begin; first < end; first += block()) {
    const Eigen::Index last = std::min(end, first + block());
    const Runs& runs = run(genomes, first, last, seed);
    for (Eigen::Index i = first; i < last; ++i) {
      double sum = 0;
      for (int s = 0; s < samples_; ++s)
        sum += outcome(runs.waypoints(static_cast<int>(i - first) * samples_ + s)).fitness();
      out[i - begin] = static_cast<float>(sum / samples_);
    }
  }
}

void ArcEvaluator::evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed seed) const {
  std::vector<ArcOutcome> outcomes(end - begin);
  execute(batch.genome, begin, end, seed, outcomes.data());
  for (Eigen::Index i = begin; i < end; ++i) {
    const ArcOutcome& outcome = outcomes[i - begin];
    batch.descriptor.row(i) = outcome.descriptor.transpose();
    batch.uncertainty[i] = outcome.uncertainty;
    batch.fitness[i] = static_cast<float>(outcome.fitness());
    batch.valid[i] = 1;
  }
}

FlatStart flat_start(const std::string& name) {
  if (name == "straight") return FlatStart::kStraight;
  if (name == "first") return FlatStart::kFirst;
  if (name == "random") return FlatStart::kRandom;
  throw InputError("start '{}': expected straight, first or random", name);
}

FlatArcEvaluator::FlatArcEvaluator(const Robot& robot, const Frame& frame, FlatStart start,
                                   ArcReading reading)
    : robot_(robot), frame_(frame), start_(start), reading_(reading) {}

void FlatArcEvaluator::evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed seed) const {
  constexpr int kStops = kArcSegments + 1;  // the start and five way-points
  const Eigen::Index dof = robot_.dof(), n = end - begin;
  std::vector<double> joints(n * kStops * dof);
  std::vector<Pen> pens(n * kStops);
  std::vector<float> start(dof, 0.5f);
  for (Eigen::Index i = 0; i < n; ++i) {
    const float* genome = batch.genome.row(begin + i).data();
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
    batch.descriptor.row(begin + i) =
        arc_descriptor(frame_, arc_shape(drawn, reading_.centre)).cast<float>().transpose();
    batch.fitness[begin + i] = static_cast<float>(-(irregularity(drawn) + cost));
    batch.valid[begin + i] = 1;
  }
}

}  // namespace hbr
