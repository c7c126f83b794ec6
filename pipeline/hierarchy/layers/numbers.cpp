#include "pipeline/hierarchy/layers/numbers.h"

#include <algorithm>
#include <limits>

#include "pipeline/core/check.h"
#include "pipeline/hierarchy/layers/image_outcome.h"
#include "pipeline/hierarchy/stack.h"

namespace hbr::inline hierarchy {
namespace {

Coordinates of_each_digit(int digits, const Coordinates& digit) {
  Coordinates all;
  for (int k = 1; k <= digits; ++k) append(all, "digit " + std::to_string(k) + " ", digit);
  return all;
}

}  // namespace

int NumberDecoder::decode(const float* genome, int /*length*/, double* commands) const {
  for (int k = 0; k < digits_; ++k)
    for (int d = 0; d < command_size_; ++d)
      *commands++ = low_ + static_cast<double>(genome[k * block() + d]) * (high_ - low_);
  return digits_;
}

Eigen::Vector2d NumberDecoder::displacement(const float* genome, int k) const {
  const float* place = genome + k * block() + command_size_;
  return frame_.point(Eigen::Vector2d(place[0], place[1]));
}

float overlap_of_strokes(const Executions& executions, int execution, int digits) {
  const PointLayer& points = executions.points();
  float sum = 0, right_before = -std::numeric_limits<float>::infinity();
  for (int k = 0; k < digits; ++k) {
    float left = std::numeric_limits<float>::infinity(), right = -left;
    for (const std::int32_t elite : executions.stroke(execution, k)) {
      left = std::min(left, points.descriptor(elite)[0]);
      right = std::max(right, points.descriptor(elite)[0]);
    }
    sum += std::max(0.0f, right_before - left);
    right_before = right;
  }
  return sum;
}

Coordinates NumberDecoder::genes() const {
  Coordinates digit = latent_coordinates(command_size_, low_, high_);
  append(digit, "", plane_coordinates("displacement", frame_.half_side));
  return of_each_digit(digits_, digit);
}

namespace {

// Descriptor: where the learned descriptor sees each digit, one after the other. Each is framed alone, as
// those that the descriptor was learned from: so every digit of a number is told from every other, and any
// number of them needs no more training. Fitness: minus the mean error of the digits, and minus by how much
// of the drawing area's side each digit reaches back over the one before it, which is what makes them stand
// from left to right.
class NumberOutcome final : public Outcome {
 public:
  NumberOutcome(const Descriptor& descriptor, const NumbersSettings& settings, Way way)
      : descriptor_(descriptor), settings_(settings), way_(way) {}
  int descriptor_size() const override {
    return settings_.digits * static_cast<int>(descriptor_.dimension());
  }
  float low() const override { return descriptor_.lower().minCoeff(); }
  float high() const override { return descriptor_.upper().maxCoeff(); }
  Way way() const override { return way_; }

  void measure(const Executions& executions, float* descriptor, float* fitness) const override {
    const int n = executions.size() * settings_.digits;
    std::vector<float> images(static_cast<std::size_t>(n) * kImagePixels), errors(n);
    for (int e = 0; e < executions.size(); ++e)
      for (int k = 0; k < settings_.digits; ++k)
        draw_stroke(executions, e, k, settings_.pencil, &images[(e * settings_.digits + k) * kImagePixels]);
    describe_images(descriptor_, n, images.data(), descriptor, errors.data());
    for (int e = 0; e < executions.size(); ++e) {
      float sum = 0;
      for (int k = 0; k < settings_.digits; ++k) sum += errors[e * settings_.digits + k];
      fitness[e] =
          sum / static_cast<float>(settings_.digits) - overlap_of_strokes(executions, e, settings_.digits);
    }
  }

 private:
  const Descriptor& descriptor_;
  NumbersSettings settings_;
  Way way_;
};

}  // namespace

std::unique_ptr<LayerModel> make_numbers(const NumbersSettings& settings, const Surroundings& around) {
  const LayerModel& digits = around.below->model(around.below->size() - 1);
  if (digits.images() != 1)
    throw InputError("numbers are built on a layer that draws one image, digits; the one below draws {}",
                     digits.images());
  const Layer& top = around.below->top();
  StackedParts numbers;
  numbers.frame = around.below->frame();
  auto decoder = std::make_unique<NumberDecoder>(numbers.frame, settings.digits, top.command_size(),
                                                 top.low(), top.high());
  numbers.genome = {decoder->genes()};
  numbers.fitness = {"the mean over its digits of " + image_fitness().meaning +
                         ", minus by how much each digit reaches back over the one before it (in shares of "
                         "the drawing area's side)",
                     ""};
  numbers.decoder = std::move(decoder);
  numbers.way = {true, settings.line_spacing, way_points_of(settings.way_points)};
  if (around.descriptor) {
    numbers.descriptor = of_each_digit(settings.digits, latent_coordinates(*around.descriptor));
    numbers.outcome = std::make_unique<NumberOutcome>(*around.descriptor, settings, numbers.way);
  }
  numbers.images = settings.digits;
  numbers.draw = [settings](const Executions& executions, int execution, float* images) {
    for (int k = 0; k < settings.digits; ++k)
      draw_stroke(executions, execution, k, settings.pencil, images + k * kImagePixels);
  };
  return stacked_model(around, std::move(numbers));
}

}  // namespace hbr::inline hierarchy
