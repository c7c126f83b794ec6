#include "pipeline/hierarchy/arc_layer.h"

#include <cmath>
#include <numbers>

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
  for (int i = 0; i < kArcSegments; ++i)
    lines[i] = length * Eigen::Vector2d(std::cos(heading + i * turn), std::sin(heading + i * turn));
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

ArcEvaluator::ArcEvaluator(const PointLayer& points, const LineLayer& lines, const Frame& frame,
                           ArcController controller, int samples)
    : points_(points), lines_(lines), frame_(frame), controller_(controller), samples_(samples) {}

ArcEvaluator::Outcome ArcEvaluator::execute(const float* genome, Rng& rng) const {
  // A line asks the same of layer 1 wherever it starts, so layer 2 is asked once.
  ArcLines requests = controller_.decode(frame_, genome);
  for (auto& line : requests) line = lines_.request(line);

  // All executions take the same step together: their look-ups do not wait for each other.
  thread_local ArcTracks tracks;
  thread_local Samples<3> descriptors;
  thread_local std::array<std::vector<std::int32_t>, kArcSegments + 1> at;
  tracks.resize(samples_);
  for (auto& elites : at) elites.resize(samples_);
  for (int s = 0; s < samples_; ++s)
    at[0][s] = static_cast<std::int32_t>(rng.below(static_cast<std::uint32_t>(points_.size())));
  for (int k = 0; k <= kArcSegments; ++k)
    for (int s = 0; s < samples_; ++s) {
      if (k > 0) at[k][s] = line_end(points_, at[k - 1][s], requests[k - 1]);
      const Eigen::Vector2d p = points_.position(at[k][s]);
      tracks.x[k][s] = p.x();
      tracks.y[k][s] = p.y();
    }
  arc_descriptors(frame_, tracks, descriptors);
  const Median<3> median = geometric_median<3>(descriptors);
  Outcome outcome{median.point, median.mean_distance, {}, 0, 0};
  for (int k = 0; k <= kArcSegments; ++k) {
    outcome.waypoints[k] = at[k][median.nearest];
    if (k > 0) outcome.joint_cost += points_.variance(outcome.waypoints[k]) / kArcSegments;
  }
  outcome.irregularity = irregularity(pen_positions(points_, outcome.waypoints));
  return outcome;
}

void ArcEvaluator::evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed seed) const {
  for (Eigen::Index i = begin; i < end; ++i) {
    Rng rng(seed.child(i));
    const Outcome outcome = execute(batch.genome.row(i).data(), rng);
    batch.descriptor.row(i) = outcome.descriptor.transpose();
    batch.uncertainty[i] = outcome.uncertainty;
    batch.fitness[i] = static_cast<float>(outcome.fitness());
    batch.valid[i] = 1;
  }
}

FlatArcEvaluator::FlatArcEvaluator(const Robot& robot, const Frame& frame) : robot_(robot), frame_(frame) {
  const Eigen::VectorXd middle = (robot.lower() + robot.upper()) / 2;
  Pen pen;
  robot.pens(1, middle.data(), &pen);
  start_ = pen.position;
}

void FlatArcEvaluator::evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed) const {
  const Eigen::Index dof = robot_.dof();
  std::vector<double> joints(kArcSegments * dof);
  std::array<Pen, kArcSegments> pens;
  ArcPoints positions;
  positions[0] = start_;
  for (Eigen::Index i = begin; i < end; ++i) {
    double variance = 0;
    for (int w = 0; w < kArcSegments; ++w) {
      decode_joints(robot_, batch.genome.row(i).data() + w * dof, &joints[w * dof]);
      variance += joint_variance(&joints[w * dof], dof);
    }
    robot_.pens(kArcSegments, joints.data(), pens.data());
    for (int w = 0; w < kArcSegments; ++w) positions[w + 1] = pens[w].position;
    const ArcShape shape = arc_shape(positions);
    batch.descriptor.row(i) = arc_descriptor(frame_, shape).cast<float>().transpose();
    batch.fitness[i] = static_cast<float>(-(irregularity(positions) + variance / kArcSegments));
    batch.valid[i] = 1;
  }
}

}  // namespace hbr
