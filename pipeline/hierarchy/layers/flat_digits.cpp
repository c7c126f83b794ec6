#include "pipeline/hierarchy/layers/flat_digits.h"

#include <algorithm>

#include "pipeline/core/check.h"
#include "pipeline/hierarchy/joints.h"
#include "pipeline/hierarchy/layers/flat_arcs.h"
#include "pipeline/hierarchy/layers/flat_model.h"
#include "pipeline/hierarchy/layers/image_outcome.h"

namespace hbr::inline hierarchy {

FlatDigits::FlatDigits(const Robot& robot, const Frame& frame, const PencilSettings& pencil,
                       FlatDigitReading reading)
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
    draw(&xy[2 * first], ends[i] - first, pencil_.width(genomes[i * stride]), framing_named(pencil_.framing),
         frame_.half_side, images + i * kImagePixels);
}

std::vector<Eigen::Vector2d> FlatDigits::tips(const float* genome, int length) const {
  std::vector<double> joints;
  append_joints(genome, length, joints);
  std::vector<Pen> pens(joints.size() / static_cast<std::size_t>(robot_.dof()));
  robot_.pens(static_cast<Eigen::Index>(pens.size()), joints.data(), pens.data());
  std::vector<Eigen::Vector2d> tips;
  for (const Pen& pen : pens) tips.push_back(pen.position);
  return tips;
}

FlatDigitEvaluator::FlatDigitEvaluator(std::shared_ptr<const FlatDigits> digits, const Descriptor& descriptor)
    : digits_(std::move(digits)), descriptor_(descriptor) {}

void FlatDigitEvaluator::evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed) const {
  std::vector<float> images((end - begin) * kImagePixels);
  digits_->draw_digits(end - begin, batch.genome.row(begin).data(), batch.genome.cols(), &batch.length[begin],
                       images.data());
  // Rows of a batch are contiguous, and so are these results.
  describe_images(descriptor_, end - begin, images.data(), batch.descriptor.row(begin).data(),
                  &batch.fitness[begin]);
  std::fill(batch.valid.begin() + begin, batch.valid.begin() + end, 1);
}

const FlatDigits& flat_digits_of(const LayerModel& layer) {
  const auto* evaluator = dynamic_cast<const FlatDigitEvaluator*>(&layer.evaluator());
  if (!evaluator) throw InputError("the layer is of another kind; expected flat digits");
  return evaluator->digits();
}

std::unique_ptr<LayerModel> make_flat_digits(const FlatDigitsSettings& settings, const Surroundings& around) {
  FlatDigitReading reading;
  if (settings.pen == "joints") reading.pen = FlatPen::kJoints;
  if (settings.start == "straight_arm") reading.start = FlatDigitStart::kStraightArm;
  FlatParts digits;
  digits.frame = {settings.half_side, 0};
  const auto flat = std::make_shared<const FlatDigits>(around.robot, digits.frame, settings.pencil, reading);
  digits.genome = {{pen_width(settings.pencil)},
                   configuration_coordinates(around.robot),
                   FlatDigits::kMaxBlocks,
                   settings.length_rate};
  digits.fitness = image_fitness();
  if (around.descriptor) {
    digits.descriptor = latent_coordinates(*around.descriptor);
    digits.evaluator = std::make_unique<FlatDigitEvaluator>(flat, *around.descriptor);
    digits.low = around.descriptor->lower().minCoeff();
    digits.high = around.descriptor->upper().maxCoeff();
  }
  digits.images = 1;
  digits.draw = [flat](const float* genome, int length, float* image) {
    flat->draw_digits(1, genome, 0, &length, image);
  };
  return flat_model("flat digits", std::move(digits));
}

}  // namespace hbr::inline hierarchy
