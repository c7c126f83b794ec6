#include "models/onnx/file/model.h"

#include <algorithm>
#include <set>

#include "models/onnx/file/fields.h"
#include "models/onnx/file/message.h"
#include "models/onnx/file/schema.h"
#include "models/onnx/file/shown.h"
#include "pipeline/core/check.h"

namespace hbr::inline onnx {
namespace {

OnnxNode read_node(std::string_view bytes) {
  OnnxNode node;
  node.bytes = bytes;
  Field f;
  for (FieldReader fields(bytes); fields.next(f);) switch (f.number) {
      case onnx::kNodeInput:
        node.inputs.emplace_back(f.bytes);
        break;
      case onnx::kNodeOutput:
        node.outputs.emplace_back(f.bytes);
        break;
      case onnx::kNodeName:
        node.name = f.bytes;
        break;
      case onnx::kOperation:
        node.operation = f.bytes;
        break;
      case onnx::kDomain:
        node.domain = f.bytes;
        break;
      default:
        break;
    }
  return node;
}

std::int64_t read_dimension_size(std::string_view bytes) {
  std::int64_t size = kOpenSize;
  Field f;
  for (FieldReader fields(bytes); fields.next(f);)
    if (f.number == onnx::kSize && static_cast<std::int64_t>(f.value) > 0)  // some write 0 or -1 for open
      size = static_cast<std::int64_t>(f.value);
  return size;
}

std::vector<std::int64_t> read_shape(std::string_view bytes) {
  std::vector<std::int64_t> shape;
  Field f;
  for (FieldReader fields(bytes); fields.next(f);)
    if (f.number == onnx::kDimension) shape.push_back(read_dimension_size(f.bytes));
  return shape;
}

OnnxValue read_value(std::string_view bytes) {
  OnnxValue value;
  Field f, type, tensor;
  for (FieldReader fields(bytes); fields.next(f);) {
    if (f.number == onnx::kValueName) value.name = f.bytes;
    if (f.number != onnx::kType) continue;
    for (FieldReader types(f.bytes); types.next(type);) {
      if (type.number != onnx::kTensorType) continue;
      for (FieldReader parts(type.bytes); parts.next(tensor);)
        if (tensor.number == onnx::kElement)
          value.type = static_cast<std::int64_t>(tensor.value);
        else if (tensor.number == onnx::kShape)
          value.shape = read_shape(tensor.bytes);
    }
  }
  return value;
}

std::string read_name_of_tensor(std::string_view bytes) {
  std::string name;
  Field f;
  for (FieldReader fields(bytes); fields.next(f);)
    if (f.number == onnx::kTensorName) name = f.bytes;
  return name;
}

void read_graph(std::string_view bytes, OnnxModel& model) {
  Field f;
  for (FieldReader fields(bytes); fields.next(f);) switch (f.number) {
      case onnx::kNode:
        model.nodes.push_back(read_node(f.bytes));
        break;
      case onnx::kInitializer:
        model.weights[read_name_of_tensor(f.bytes)] = f.bytes;
        break;
      case onnx::kInput:
        model.inputs.push_back(read_value(f.bytes));
        break;
      case onnx::kOutput:
        model.outputs.push_back(read_value(f.bytes));
        break;
      default:
        break;
    }
  std::erase_if(model.inputs, [&](const OnnxValue& input) { return model.weights.contains(input.name); });
}

void check_order(const OnnxModel& model) {
  std::set<std::string> known{""};
  for (const auto& [name, bytes] : model.weights) known.insert(name);
  for (const OnnxValue& input : model.inputs) known.insert(input.name);
  for (const OnnxNode& node : model.nodes) {
    if (std::ranges::all_of(node.outputs, [](const std::string& output) { return output.empty(); }))
      throw InputError("not an ONNX network, or a damaged one: node '{}' ({}) makes nothing",
                       shown(node.name), shown(node.operation));
    for (const std::string& input : node.inputs)
      if (!known.contains(input))
        throw InputError(
            "not an ONNX network, or a damaged one: node '{}' ({}) reads '{}', which nothing "
            "before it makes",
            shown(node.name), shown(node.operation), shown(input));
    for (const std::string& output : node.outputs)
      if (!known.insert(output).second && !output.empty())
        throw InputError("not an ONNX network, or a damaged one: node '{}' ({}) makes '{}', which is there",
                         shown(node.name), shown(node.operation), shown(output));
  }
}

Message float_value(const std::string& name, const std::vector<std::int64_t>& shape) {
  Message dims;
  for (const std::int64_t d : shape) dims.message(onnx::kDimension, Message().number(onnx::kSize, d));
  const Message tensor = Message().number(onnx::kElement, onnx::kFloat).message(onnx::kShape, dims);
  return Message()
      .text(onnx::kValueName, name)
      .message(onnx::kType, Message().message(onnx::kTensorType, tensor));
}

}  // namespace

const std::string& OnnxNode::first_output() const {
  return *std::ranges::find_if(outputs, [](const std::string& output) { return !output.empty(); });
}

OnnxModel parse_onnx(std::string_view bytes) {
  OnnxModel model;
  Message head;
  Field f;
  for (FieldReader fields(bytes); fields.next(f);)
    if (f.number == onnx::kGraph)
      read_graph(f.bytes, model);
    else
      head.copy(f.whole);
  if (model.nodes.empty()) throw InputError("not an ONNX network: it has no nodes");
  check_order(model);
  model.head = head.bytes();
  return model;
}

std::vector<const OnnxNode*> needed_nodes(const OnnxModel& model, const std::vector<std::string>& tensors) {
  std::set<std::string> wanted(tensors.begin(), tensors.end());
  std::vector<const OnnxNode*> nodes;
  for (auto node = model.nodes.rbegin(); node != model.nodes.rend(); ++node) {
    if (std::ranges::none_of(node->outputs, [&](const auto& o) { return wanted.contains(o); })) continue;
    nodes.push_back(&*node);
    wanted.insert(node->inputs.begin(), node->inputs.end());
  }
  std::ranges::reverse(nodes);
  return nodes;
}

std::string part_of(const OnnxModel& model, const std::vector<std::string>& tensors,
                    const std::vector<std::int64_t>& input_shape) {
  Message graph;
  std::set<std::string> read;
  for (const OnnxNode* node : needed_nodes(model, tensors)) {
    graph.message(onnx::kNode, Message().copy(node->bytes));
    read.insert(node->inputs.begin(), node->inputs.end());
  }
  graph.text(onnx::kGraphName, "part");
  for (const auto& [name, tensor] : model.weights)
    if (read.contains(name)) graph.message(onnx::kInitializer, Message().copy(tensor));
  for (const OnnxValue& input : model.inputs)
    graph.message(onnx::kInput, float_value(input.name, input_shape));
  // OpenCV wants shapes of outputs and does not look at them.
  for (const std::string& tensor : tensors) graph.message(onnx::kOutput, float_value(tensor, {}));
  return Message().copy(model.head).message(onnx::kGraph, graph).bytes();
}

}  // namespace hbr::inline onnx
