// How a network from an ONNX file is to be read.
#pragma once

#include <string>
#include <vector>

#include "pipeline/core/settings.h"

namespace hbr::inline onnx {

struct OnnxSettings {
  std::string position, reconstruction;
  std::vector<int> input_shape;
  std::vector<double> input_range{0, 1}, reconstruction_range{0, 1};
};
template <class Fields>
void describe(Fields& f, OnnxSettings& s) {
  f.text("position", s.position, "the tensor that is the position; '' where only one can be");
  f.text("reconstruction", s.reconstruction,
         "the tensor that is the image again; '' where only one output has 784 numbers");
  f.numbers("input_shape", s.input_shape, Range{1, 784},
            "of one image, such as [1, 1, 28, 28], [1, 28, 28, 1] or [1, 784]; [] where the file tells it");
  f.numbers("input_range", s.input_range, Range{-1e6, 1e6}, "what black and white are at the input");
  f.numbers("reconstruction_range", s.reconstruction_range, Range{-1e6, 1e6},
            "what black and white are in the reconstruction");
}

// What is wrong with them, in one line; empty where nothing is.
inline std::string fault_of(const OnnxSettings& s) {
  const auto is_range = [](const std::vector<double>& r) { return r.size() == 2 && r[0] != r[1]; };
  if (!is_range(s.input_range)) return "input_range: expected two different numbers, black and white";
  if (!is_range(s.reconstruction_range))
    return "reconstruction_range: expected two different numbers, black and white";
  int numbers = 1;
  for (const int size : s.input_shape)
    if (784 % size != 0 || (numbers *= size) > 784)
      return "input_shape: expected sizes that make 784 numbers";
  if (!s.input_shape.empty() && numbers != 784) return "input_shape: expected sizes that make 784 numbers";
  return "";
}

}  // namespace hbr::inline onnx
