// A first run of a network, and what it says across to the process that asked for it.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace hbr::inline onnx {

struct TensorShape {
  std::vector<int> sizes;
  bool floats = false;

  std::size_t numbers() const;
  std::string text() const;  // "1 x 2"
};

// What a first run gave: the shapes of the tensors that OpenCV gives, and a hash of their numbers.
struct Trial {
  std::map<std::string, TensorShape> shapes;
  std::uint64_t hash = 0;
};

// Shapes stand in the order of `tensors`, whose names may be any bytes.
std::string told(const Trial& trial, const std::vector<std::string>& tensors);

// A network that is damaged, or was made to do harm, may have led the other process astray, which then may
// say anything: throws InputError, with `where` before the words, where that is no trial of these tensors.
Trial understood(const std::string& where, const std::string& text, const std::vector<std::string>& tensors);

}  // namespace hbr::inline onnx
