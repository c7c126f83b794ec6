#include "models/onnx/input_shape.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "models/onnx/file/schema.h"
#include "models/onnx/file/shown.h"
#include "pipeline/core/check.h"
#include "pipeline/drawing/draw.h"

namespace hbr::inline onnx {
namespace {

using Sizes = std::vector<std::int64_t>;

std::string shape_text(const Sizes& shape) {
  std::vector<std::string> sizes;
  for (const std::int64_t size : shape) sizes.push_back(size == kOpenSize ? "?" : std::to_string(size));
  return fmt::format("{}", fmt::join(sizes, " x "));
}

// How many numbers these are where open sizes are 1; more than an image has where they are too many.
std::int64_t numbers_of(Sizes::const_iterator begin, Sizes::const_iterator end) {
  std::int64_t numbers = 1;
  for (; begin != end && numbers <= kImagePixels; ++begin)
    numbers *= *begin == kOpenSize ? 1 : std::min<std::int64_t>(*begin, kImagePixels + 1);
  return numbers;
}

std::vector<int> closed(const Sizes& shape) {
  std::vector<int> sizes;
  for (const std::int64_t size : shape) sizes.push_back(size == kOpenSize ? 1 : static_cast<int>(size));
  return sizes;
}

// The batch's size, the first, may be any.
bool agrees(const std::vector<int>& sizes, const Sizes& shape) {
  if (sizes.size() != shape.size()) return false;
  for (std::size_t i = 1; i < sizes.size(); ++i)
    if (shape[i] != kOpenSize && shape[i] != sizes[i]) return false;
  return true;
}

const OnnxValue& only_input(const OnnxModel& model) {
  if (model.inputs.size() == 1) return model.inputs.front();
  std::vector<std::string> names;
  for (const OnnxValue& input : model.inputs) names.push_back(fmt::format("'{}'", shown(input.name)));
  throw InputError("expected a network of one input, images; found {}: {}", names.size(),
                   fmt::join(names, ", "));
}

}  // namespace

std::vector<std::vector<int>> input_shapes(const OnnxModel& model, const std::vector<int>& told) {
  const OnnxValue& input = only_input(model);
  if (input.type != onnx::kFloat)
    throw InputError("its input '{}' is of the type {} of onnx.proto; expected real numbers",
                     shown(input.name), input.type);
  std::vector<std::vector<int>> shapes{{1, 1, kImageSide, kImageSide},
                                       {1, kImageSide, kImageSide, 1},
                                       {1, kImageSide, kImageSide},
                                       {1, kImagePixels}};
  if (!told.empty()) {
    if (input.shape && !agrees(told, *input.shape))
      throw InputError("input_shape = [{}], but its input '{}' is {}", fmt::join(told, ", "),
                       shown(input.name), shape_text(*input.shape));
    return {told};
  }
  if (!input.shape) return shapes;
  Sizes shape = *input.shape;
  if (numbers_of(shape.begin(), shape.end()) == kImagePixels) return {closed(shape)};
  if (!shape.empty() && numbers_of(shape.begin() + 1, shape.end()) == kImagePixels) {
    shape.front() = 1;
    return {closed(shape)};
  }
  std::erase_if(shapes, [&](const std::vector<int>& sizes) { return !agrees(sizes, shape); });
  if (shapes.empty())
    throw InputError(
        "expected a network that takes images n x 784, n x 1 x 28 x 28, n x 28 x 28 x 1 or n x "
        "28 x 28; its input '{}' is {}",
        shown(input.name), shape_text(shape));
  return shapes;
}

}  // namespace hbr::inline onnx
