// How a network takes an image.
#pragma once

#include <vector>

#include "models/onnx/file/model.h"

namespace hbr::inline onnx {

// The shapes of a batch of one image that the network's input may have, most usual first: one where the file
// tells it, several where it leaves sizes open. `told`: a shape that goes before. Throws InputError where the
// network takes something else than one image of 784 real numbers.
std::vector<std::vector<int>> input_shapes(const OnnxModel& model, const std::vector<int>& told);

}  // namespace hbr::inline onnx
