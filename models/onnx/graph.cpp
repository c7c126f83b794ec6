#include "models/onnx/graph.h"

namespace hbr {
namespace {

// Field and enumeration numbers of onnx.proto3.
enum ModelField { kIrVersion = 1, kProducer = 2, kGraph = 7, kOperators = 8 };
enum GraphField { kNode = 1, kGraphName = 2, kInitializer = 5, kInput = 11, kOutput = 12 };
enum NodeField { kNodeInput = 1, kNodeOutput = 2, kNodeName = 3, kOperation = 4, kAttribute = 5 };
enum AttributeField { kName = 1, kReal = 2, kInteger = 3, kText = 4, kIntegers = 8, kType = 20 };
enum AttributeType { kIsReal = 1, kIsInteger = 2, kIsText = 3, kIsIntegers = 7 };
enum TensorField { kDims = 1, kDataType = 2, kTensorName = 8, kRawData = 9 };
enum DataType { kFloat = 1, kInt64 = 7 };

constexpr int kIr = 7, kOperatorSet = 13;

template <class... Cases>
struct Overload : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overload(Cases...) -> Overload<Cases...>;  // clang needs to be told

Message attribute(const OnnxAttribute& a) {
  Message m;
  m.text(kName, a.name);
  std::visit(Overload{[&](std::int64_t v) { m.number(kInteger, v).number(kType, kIsInteger); },
                      [&](float v) { m.real(kReal, v).number(kType, kIsReal); },
                      [&](const std::string& v) { m.text(kText, v).number(kType, kIsText); },
                      [&](const std::vector<std::int64_t>& all) {
                        for (const std::int64_t v : all) m.number(kIntegers, v);
                        m.number(kType, kIsIntegers);
                      }},
             a.value);
  return m;
}

// ValueInfoProto: name and TypeProto { tensor_type { elem_type, shape { dim { dim_value or dim_param } } } }.
Message batch_of(const std::string& name, const std::vector<std::int64_t>& shape) {
  Message dims;
  dims.message(1, Message().text(2, "n"));
  for (const std::int64_t d : shape) dims.message(1, Message().number(1, d));
  const Message tensor = Message().number(1, kFloat).message(2, dims);
  return Message().text(1, name).message(2, Message().message(1, tensor));
}

template <class T>
Message tensor(const std::string& name, DataType type, const std::vector<std::int64_t>& shape,
               const std::vector<T>& values) {
  Message m;
  for (const std::int64_t d : shape) m.number(kDims, d);
  return m.number(kDataType, type)
      .text(kTensorName, name)
      .text(kRawData, Message::little_endian(values.data(), values.size()));
}

}  // namespace

void OnnxGraph::input(const std::string& name, const std::vector<std::int64_t>& shape) {
  graph_.message(kInput, batch_of(name, shape));
}

void OnnxGraph::output(const std::string& name, const std::vector<std::int64_t>& shape) {
  graph_.message(kOutput, batch_of(name, shape));
}

void OnnxGraph::weights(const std::string& name, const std::vector<std::int64_t>& shape,
                        const std::vector<float>& values) {
  graph_.message(kInitializer, tensor(name, kFloat, shape, values));
}

void OnnxGraph::numbers(const std::string& name, const std::vector<std::int64_t>& values) {
  graph_.message(kInitializer, tensor(name, kInt64, {static_cast<std::int64_t>(values.size())}, values));
}

void OnnxGraph::node(const std::string& operation, const std::vector<std::string>& inputs,
                     const std::string& output, const std::vector<OnnxAttribute>& attributes) {
  Message m;
  for (const std::string& input : inputs) m.text(kNodeInput, input);
  m.text(kNodeOutput, output).text(kNodeName, output).text(kOperation, operation);
  for (const OnnxAttribute& a : attributes) m.message(kAttribute, attribute(a));
  graph_.message(kNode, m);
}

std::string OnnxGraph::bytes() const {
  Message graph = graph_;
  graph.text(kGraphName, "hbr");
  return Message()
      .number(kIrVersion, kIr)
      .text(kProducer, "hbr")
      .message(kGraph, graph)
      .message(kOperators, Message().text(1, "").number(2, kOperatorSet))
      .bytes();
}

}  // namespace hbr
