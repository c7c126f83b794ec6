#include "pipeline/hierarchy/line_layer.h"

#include <algorithm>
#include <cmath>

#include "pipeline/hierarchy/geometric_median.h"

namespace hbr {

Eigen::Vector2d decode_line(const Frame& frame, const float* genes) {
  const Eigen::Vector2d line = frame.line(Eigen::Vector2d(genes[0], genes[1]));
  return frame.line_range == LineRange::kDisc ? at_most(line, frame.longest_line) : line;
}

std::int32_t line_end(const PointLayer& points, std::int32_t start, const Eigen::Vector2d& displacement) {
  const Eigen::Vector2f step = points.frame().point_step(displacement);
  const float* from = points.descriptor(start);
  const float query[2] = {from[0] + step.x(), from[1] + step.y()};
  return points.nearest(query);
}

void line_ends(const PointLayer& points, int n, const std::int32_t* starts, const float* step_x,
               const float* step_y, std::int32_t* ends) {
  constexpr int kChunk = 256;
  float x[kChunk], y[kChunk];
  for (int begin = 0; begin < n; begin += kChunk) {
    const int count = std::min(kChunk, n - begin);
    for (int i = 0; i < count; ++i) {
      const float* from = points.descriptor(starts[begin + i]);
      x[i] = from[0] + step_x[begin + i];
      y[i] = from[1] + step_y[begin + i];
    }
    points.nearest(count, {x, y}, ends + begin);
  }
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

void LineLayer::requests(int n, const std::array<const float*, 2>& wanted, float* step_x,
                         float* step_y) const {
  constexpr int kChunk = 256;
  std::int32_t found[kChunk];
  for (int begin = 0; begin < n; begin += kChunk) {
    const int count = std::min(kChunk, n - begin);
    table_.nearest(count, {wanted[0] + begin, wanted[1] + begin}, found);
    for (int i = 0; i < count; ++i) {
      const Eigen::Vector2f step = frame_.point_step(requests_[found[i]]);
      step_x[begin + i] = step.x();
      step_y[begin + i] = step.y();
    }
  }
}

LineEvaluator::LineEvaluator(const PointLayer& points, const Frame& frame, int samples)
    : points_(points), frame_(frame), samples_(samples) {}

void LineEvaluator::evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed seed) const {
  const auto n = static_cast<int>(end - begin) * samples_;
  const auto elites = static_cast<std::uint32_t>(points_.size());
  thread_local std::vector<std::int32_t> starts, ends;
  thread_local std::vector<float> step_x, step_y;
  thread_local Samples<2> samples;
  starts.resize(n);
  ends.resize(n);
  step_x.resize(n);
  step_y.resize(n);
  samples.resize(samples_);

  for (Eigen::Index i = begin; i < end; ++i) {
    const auto first = (i - begin) * samples_;
    const Eigen::Vector2f step = frame_.point_step(decode_line(frame_, batch.genome.row(i).data()));
    std::fill_n(&step_x[first], samples_, step.x());
    std::fill_n(&step_y[first], samples_, step.y());
    Rng rng(seed.child(i));
    for (int s = 0; s < samples_; ++s) starts[first + s] = static_cast<std::int32_t>(rng.below(elites));
  }
  line_ends(points_, n, starts.data(), step_x.data(), step_y.data(), ends.data());

  const auto scale = static_cast<float>(frame_.half_side / frame_.longest_line);
  for (Eigen::Index i = begin; i < end; ++i) {
    for (int s = 0; s < samples_; ++s) {
      const auto at = (i - begin) * samples_ + s;
      const float *from = points_.descriptor(starts[at]), *to = points_.descriptor(ends[at]);
      for (int d = 0; d < 2; ++d) samples.coordinate(d)[s] = (to[d] - from[d]) * scale + 0.5f;
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
  const auto scale = static_cast<float>(frame_.half_side / frame_.longest_line);
  for (Eigen::Index i = begin; i < end; ++i) {
    Rng rng(seed.child(i));
    const auto start = static_cast<std::int32_t>(rng.below(static_cast<std::uint32_t>(points_.size())));
    const std::int32_t stop = line_end(points_, start, decode_line(frame_, batch.genome.row(i).data()));
    const float *from = points_.descriptor(start), *to = points_.descriptor(stop);
    batch.descriptor.row(i) << from[0], from[1], (to[0] - from[0]) * scale + 0.5f,
        (to[1] - from[1]) * scale + 0.5f;
    batch.fitness[i] = 0;
    batch.valid[i] = 1;
  }
}

}  // namespace hbr
