#include "pipeline/hierarchy/digit_layer.h"

#include <algorithm>

namespace hbr {
namespace {

// Draws rows [begin, end) with draw_row(genome, length, image) and has them described together.
template <class DrawRow>
void evaluate_images(const Descriptor& descriptor, Batch& batch, Eigen::Index begin, Eigen::Index end,
                     DrawRow&& draw_row) {
  const Eigen::Index n = end - begin;
  std::vector<float> images(n * kImagePixels);
  for (Eigen::Index i = 0; i < n; ++i)
    draw_row(batch.genome.row(begin + i).data(), batch.length[begin + i], &images[i * kImagePixels]);
  // Rows of a batch are contiguous, and so are these results.
  descriptor.describe(n, images.data(), batch.descriptor.row(begin).data(), &batch.fitness[begin]);
  batch.fitness.segment(begin, n) *= -1;
  std::fill(batch.valid.begin() + begin, batch.valid.begin() + end, 1);
}

}  // namespace

Hierarchy::Hierarchy(const PointLayer& points, const LineLayer& lines, const ArcLayer& arcs,
                     const Frame& frame, double spacing)
    : points_(points), lines_(lines), arcs_(arcs), frame_(frame), spacing_(spacing) {}

void Hierarchy::digit_path(const float* genome, int length, std::vector<std::int32_t>& path) const {
  path.assign(1, points_.nearest(frame_.point(Eigen::Vector2d(genome[0], genome[1]))));
  for (int at = kDigitHead; at < length; at += kDigitBlock) {
    const std::int32_t arc = arcs_.nearest(decode_arc(frame_, genome + at));
    for (const Eigen::Vector2d& wanted : arcs_.lines(arc)) {
      const Eigen::Vector2d displacement = lines_.request(wanted);
      if (spacing_ > 0)
        line_path(points_, path.back(), displacement, spacing_, path);
      else
        path.push_back(line_end(points_, path.back(), displacement));
    }
  }
}

Trace Hierarchy::trace(const std::vector<std::int32_t>& path) const {
  Trace trace;
  for (const std::int32_t elite : path) {
    const Eigen::Vector2d p = points_.position(elite);
    trace.pen.insert(trace.pen.end(), {static_cast<float>(p.x()), static_cast<float>(p.y())});
    trace.joints.insert(trace.joints.end(), points_.joints(elite), points_.joints(elite) + points_.dof());
  }
  return trace;
}

void draw_digit(const Hierarchy& hierarchy, const Pencil& pencil, const float* genome, int length,
                float* image) {
  thread_local std::vector<std::int32_t> path;
  thread_local std::vector<float> pen;
  hierarchy.digit_path(genome, length, path);
  pen.clear();
  for (const std::int32_t elite : path) {
    const Eigen::Vector2f p = hierarchy.points().position(elite).cast<float>();
    pen.insert(pen.end(), {p.x(), p.y()});
  }
  draw(pen.data(), static_cast<Eigen::Index>(path.size()), pencil.width(genome[2]), pencil.framing,
       hierarchy.frame().half_side, image);
}

DigitEvaluator::DigitEvaluator(const Hierarchy& hierarchy, const Pencil& pencil, const Descriptor& descriptor)
    : hierarchy_(hierarchy), pencil_(pencil), descriptor_(descriptor) {}

void DigitEvaluator::evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed) const {
  evaluate_images(descriptor_, batch, begin, end, [&](const float* genome, int length, float* image) {
    draw_digit(hierarchy_, pencil_, genome, length, image);
  });
}

FlatDigits::FlatDigits(const Robot& robot, const Frame& frame, const Pencil& pencil)
    : robot_(robot), frame_(frame), pencil_(pencil) {}

void FlatDigits::draw_digit(const float* genome, int length, float* image) const {
  const Eigen::Index dof = robot_.dof(), configurations = (length - kHead) / dof;
  thread_local std::vector<double> joints;
  thread_local std::vector<Pen> pens;
  thread_local std::vector<float> xy;
  joints.resize(configurations * dof);
  pens.resize(configurations);
  xy.resize(2 * configurations);
  for (Eigen::Index c = 0; c < configurations; ++c)
    decode_joints(robot_, genome + kHead + c * dof, &joints[c * dof]);
  robot_.pens(configurations, joints.data(), pens.data());
  for (Eigen::Index c = 0; c < configurations; ++c)
    Eigen::Vector2f::Map(&xy[2 * c]) = pens[c].position.cast<float>();
  draw(xy.data(), configurations, pencil_.width(genome[0]), pencil_.framing, frame_.half_side, image);
}

FlatDigitEvaluator::FlatDigitEvaluator(const FlatDigits& digits, const Descriptor& descriptor)
    : digits_(digits), descriptor_(descriptor) {}

void FlatDigitEvaluator::evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed) const {
  evaluate_images(descriptor_, batch, begin, end, [&](const float* genome, int length, float* image) {
    digits_.draw_digit(genome, length, image);
  });
}

}  // namespace hbr
