// What an ONNX file says of its network: nodes, weights, inputs and outputs.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hbr::inline onnx {

struct OnnxNode {
  std::string name, operation, domain;
  std::vector<std::string> inputs, outputs;  // "" where an optional one is left out
  std::string bytes;                         // the NodeProto

  const std::string& first_output() const;  // that is not left out
};

constexpr std::int64_t kOpenSize = -1;  // a size that the file leaves open

struct OnnxValue {
  std::string name;
  std::int64_t type = 0;                           // onnx::DataType
  std::optional<std::vector<std::int64_t>> shape;  // none where the file has none
};

struct OnnxModel {
  std::string head;                            // of the ModelProto all but the graph
  std::vector<OnnxNode> nodes;                 // each reads what stands before it
  std::map<std::string, std::string> weights;  // by name, the TensorProto
  std::vector<OnnxValue> inputs, outputs;      // of the inputs those that are no weights
};

// Throws InputError where the bytes are no ONNX network, or nodes read what nothing makes.
OnnxModel parse_onnx(std::string_view bytes);

// The nodes that it takes to make `tensors`, in the order of the file.
std::vector<const OnnxNode*> needed_nodes(const OnnxModel& model, const std::vector<std::string>& tensors);

// The ONNX file of so much of the network as it takes to make `tensors`, its outputs, of float32 inputs of
// these shapes.
std::string part_of(const OnnxModel& model, const std::vector<std::string>& tensors,
                    const std::vector<std::int64_t>& input_shape);

}  // namespace hbr::inline onnx
