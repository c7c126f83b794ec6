#include "pipeline/hierarchy/digit_layer.h"

#include <algorithm>

#include "pipeline/core/check.h"

namespace hbr {
namespace {

// Has the images of rows [begin, end) described together.
void describe_images(const Descriptor& descriptor, const std::vector<float>& images, Batch& batch,
                     Eigen::Index begin, Eigen::Index end) {
  // Rows of a batch are contiguous, and so are these results.
  descriptor.describe(end - begin, images.data(), batch.descriptor.row(begin).data(), &batch.fitness[begin]);
  batch.fitness.segment(begin, end - begin) *= -1;
}

}  // namespace

Hierarchy::Hierarchy(const PointLayer& points, const LineLayer& lines, const ArcLayer& arcs,
                     const Frame& frame, double spacing, OutOfRange out_of_range)
    : points_(points),
      lines_(lines),
      arcs_(arcs),
      frame_(frame),
      spacing_(spacing),
      out_of_range_(out_of_range) {}

bool Hierarchy::digit_path(const float* genome, int length, std::vector<std::int32_t>& path) const {
  path.assign(1, points_.nearest(frame_.point(Eigen::Vector2d(genome[0], genome[1]))));
  for (int at = kDigitHead; at < length; at += kDigitBlock) {
    const auto wanted_arc = decode_arc(frame_, out_of_range_, genome + at);
    if (!wanted_arc) return false;
    for (const Eigen::Vector2d& wanted : arcs_.lines(arcs_.nearest(*wanted_arc))) {
      const Eigen::Vector2d displacement = lines_.request(wanted);
      if (spacing_ > 0)
        line_path(points_, path.back(), displacement, spacing_, path);
      else
        path.push_back(line_end(points_, path.back(), displacement));
    }
  }
  return true;
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

bool draw_digit(const Hierarchy& hierarchy, const Pencil& pencil, const float* genome, int length,
                float* image) {
  thread_local std::vector<std::int32_t> path;
  thread_local std::vector<float> pen;
  if (!hierarchy.digit_path(genome, length, path)) return false;
  pen.clear();
  for (const std::int32_t elite : path) {
    const Eigen::Vector2f p = hierarchy.points().position(elite).cast<float>();
    pen.insert(pen.end(), {p.x(), p.y()});
  }
  draw(pen.data(), static_cast<Eigen::Index>(path.size()), pencil.width(genome[2]), pencil.framing,
       hierarchy.frame().half_side, image);
  return true;
}

DigitEvaluator::DigitEvaluator(const Hierarchy& hierarchy, const Pencil& pencil, const Descriptor& descriptor)
    : hierarchy_(hierarchy), pencil_(pencil), descriptor_(descriptor) {}

void DigitEvaluator::evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed) const {
  // What is rejected is described as an empty image, for nobody to read.
  std::vector<float> images((end - begin) * kImagePixels);
  for (Eigen::Index i = begin; i < end; ++i)
    batch.valid[i] = draw_digit(hierarchy_, pencil_, batch.genome.row(i).data(), batch.length[i],
                                &images[(i - begin) * kImagePixels]);
  describe_images(descriptor_, images, batch, begin, end);
}

FlatDigitReading flat_digit_reading(const std::string& pen, const std::string& start) {
  FlatDigitReading reading;
  if (pen == "joints")
    reading.pen = FlatPen::kJoints;
  else if (pen != "straight")
    throw InputError("pen '{}': expected straight or joints", pen);
  if (start == "straight_arm")
    reading.start = FlatDigitStart::kStraightArm;
  else if (start != "first")
    throw InputError("start '{}': expected first or straight_arm", start);
  return reading;
}

FlatDigits::FlatDigits(const Robot& robot, const Frame& frame, const Pencil& pencil, FlatDigitReading reading)
    : robot_(robot), frame_(frame), pencil_(pencil), reading_(reading), straight_arm_(robot.dof()) {
  Eigen::VectorXd::Map(straight_arm_.data(), robot.dof()) = (robot.lower() + robot.upper()) / 2;
}

void FlatDigits::append_joints(const float* genome, int length, std::vector<double>& joints) const {
  const Eigen::Index dof = robot_.dof();
  bool begun = reading_.start == FlatDigitStart::kStraightArm;
  if (begun) joints.insert(joints.end(), straight_arm_.begin(), straight_arm_.end());
  for (Eigen::Index at = kHead; at < length; at += dof, begun = true) {
    // Sub-steps lead to every configuration that has one before it.
    const int steps = begun && reading_.pen == FlatPen::kJoints ? kFlatSubSteps : 1;
    const std::size_t first = joints.size();
    joints.resize(first + steps * dof);
    double* const next = &joints[first];
    double* const to = next + (steps - 1) * dof;
    decode_joints(robot_, genome + at, to);
    for (int s = 1; s < steps; ++s)
      for (Eigen::Index j = 0; j < dof; ++j) {
        const double from = next[j - dof];
        next[(s - 1) * dof + j] = from + (to[j] - from) * s / steps;
      }
  }
}

void FlatDigits::draw_digits(Eigen::Index n, const float* genomes, Eigen::Index stride,
                             const std::int32_t* lengths, float* images) const {
  thread_local std::vector<double> joints;
  thread_local std::vector<Pen> pens;
  thread_local std::vector<float> xy;
  thread_local std::vector<Eigen::Index> ends;  // in points, of every genome's
  joints.clear();
  ends.clear();
  for (Eigen::Index i = 0; i < n; ++i) {
    append_joints(genomes + i * stride, lengths[i], joints);
    ends.push_back(static_cast<Eigen::Index>(joints.size()) / robot_.dof());
  }
  const Eigen::Index points = n > 0 ? ends.back() : 0;
  pens.resize(points);
  xy.resize(2 * points);
  robot_.pens(points, joints.data(), pens.data());
  for (Eigen::Index p = 0; p < points; ++p) Eigen::Vector2f::Map(&xy[2 * p]) = pens[p].position.cast<float>();
  for (Eigen::Index i = 0, first = 0; i < n; first = ends[i++])
    draw(&xy[2 * first], ends[i] - first, pencil_.width(genomes[i * stride]), pencil_.framing,
         frame_.half_side, images + i * kImagePixels);
}

FlatDigitEvaluator::FlatDigitEvaluator(const FlatDigits& digits, const Descriptor& descriptor)
    : digits_(digits), descriptor_(descriptor) {}

void FlatDigitEvaluator::evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed) const {
  std::vector<float> images((end - begin) * kImagePixels);
  digits_.draw_digits(end - begin, batch.genome.row(begin).data(), batch.genome.cols(), &batch.length[begin],
                      images.data());
  describe_images(descriptor_, images, batch, begin, end);
  std::fill(batch.valid.begin() + begin, batch.valid.begin() + end, 1);
}

}  // namespace hbr
