// How an image gets from a network's input to what the network makes of it.
#pragma once

#include <string>
#include <vector>

#include "models/onnx/file/model.h"

namespace hbr::inline onnx {

struct FlowTensor {
  std::string name;
  std::size_t node;  // that makes it
  bool only_way;     // all that its successors know of the image has passed through it
};

// The tensors that depend on the numbers of `input` and that `ends` depend on, in the order of the nodes; an
// end is one of them. A tensor's shape is no number of it: nothing that is made of shapes alone depends on
// the input.
std::vector<FlowTensor> flow(const OnnxModel& model, const std::string& input,
                             const std::vector<std::string>& ends);

}  // namespace hbr::inline onnx
