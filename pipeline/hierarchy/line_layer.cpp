#include "pipeline/hierarchy/line_layer.h"

#include <cmath>

#include "pipeline/hierarchy/geometric_median.h"

namespace hbr {

Eigen::Vector2d decode_line(const Frame& frame, const float* genes) {
  return at_most(frame.line(Eigen::Vector2d(genes[0], genes[1])), frame.longest_line);
}

void line_path(const PointLayer& points, std::int32_t start, const Eigen::Vector2d& displacement,
               double spacing, std::vector<std::int32_t>& path) {
  const Eigen::Vector2d origin = points.position(start);
  const int steps = std::max(1, static_cast<int>(std::ceil(displacement.norm() / spacing)));
  std::int32_t here = start;
  for (int i = 1; i <= steps; ++i) {
    const std::int32_t next = points.nearest(origin + displacement * (static_cast<double>(i) / steps));
    if (next != here) path.push_back(here = next);
  }
}

LineLayer::LineLayer(const Elites& elites, const Frame& frame)
    : frame_(frame), table_(elites.measures, -0.25f, 1.25f, 8) {
  for (Eigen::Index i = 0; i < elites.size(); ++i)
    requests_.push_back(decode_line(frame, elites.solution.row(i).data()));
}

LineEvaluator::LineEvaluator(const PointLayer& points, const Frame& frame, int samples)
    : points_(points), frame_(frame), samples_(samples) {}

void LineEvaluator::evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed seed) const {
  thread_local Samples<2> samples;
  samples.resize(samples_);
  for (Eigen::Index i = begin; i < end; ++i) {
    Rng rng(seed.child(i));
    const Eigen::Vector2d displacement = decode_line(frame_, batch.genome.row(i).data());
    for (int s = 0; s < samples_; ++s) {
      const auto start = static_cast<std::int32_t>(rng.below(static_cast<std::uint32_t>(points_.size())));
      const std::int32_t stop = line_end(points_, start, displacement);
      const Eigen::Vector2f drawn =
          frame_.line_descriptor(points_.position(stop) - points_.position(start)).cast<float>();
      samples.coordinate(0)[s] = drawn.x();
      samples.coordinate(1)[s] = drawn.y();
    }
    const Median<2> median = geometric_median<2>(samples);
    batch.descriptor.row(i) = median.point.transpose();
    batch.uncertainty[i] = median.mean_distance;
    batch.fitness[i] = 0;
    batch.valid[i] = 1;
  }
}

LineFromStartEvaluator::LineFromStartEvaluator(const PointLayer& points, const Frame& frame)
    : points_(points), frame_(frame) {}

void LineFromStartEvaluator::evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed seed) const {
  for (Eigen::Index i = begin; i < end; ++i) {
    Rng rng(seed.child(i));
    const auto start = static_cast<std::int32_t>(rng.below(static_cast<std::uint32_t>(points_.size())));
    const std::int32_t stop = line_end(points_, start, decode_line(frame_, batch.genome.row(i).data()));
    const Eigen::Vector2d from = points_.position(start);
    batch.descriptor.row(i) << frame_.point_descriptor(from).cast<float>().transpose(),
        frame_.line_descriptor(points_.position(stop) - from).cast<float>().transpose();
    batch.fitness[i] = 0;
    batch.valid[i] = 1;
  }
}

}  // namespace hbr
