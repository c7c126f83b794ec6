#include "models/onnx/graph.h"

#include "models/onnx/file/schema.h"

namespace hbr::inline onnx {
namespace {

using namespace onnx;

constexpr int kIr = 7, kOperatorSet = 13;

template <class... Cases>
struct Overload : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overload(Cases...) -> Overload<Cases...>;  // clang needs to be told

Message attribute(const OnnxAttribute& a) {
  Message m;
  m.text(kAttributeName, a.name);
  std::visit(Overload{[&](std::int64_t v) { m.number(kInteger, v).number(kAttributeType, kIsInteger); },
                      [&](float v) { m.real(kReal, v).number(kAttributeType, kIsReal); },
                      [&](const std::string& v) { m.text(kText, v).number(kAttributeType, kIsText); },
                      [&](const std::vector<std::int64_t>& all) {
                        for (const std::int64_t v : all) m.number(kIntegers, v);
                        m.number(kAttributeType, kIsIntegers);
                      }},
             a.value);
  return m;
}

// A batch of float32, with what it means.
Message batch_of(const std::string& name, const std::vector<std::int64_t>& shape,
                 const std::string& meaning) {
  Message dims;
  dims.message(kDimension, Message().text(kSizeName, "n"));
  for (const std::int64_t d : shape) dims.message(kDimension, Message().number(kSize, d));
  const Message tensor = Message().number(kElement, kFloat).message(kShape, dims);
  Message value = Message().text(kValueName, name).message(kType, Message().message(kTensorType, tensor));
  return meaning.empty() ? value : value.text(kValueDoc, meaning);
}

template <class T>
Message tensor(const std::string& name, DataType type, const std::vector<std::int64_t>& shape,
               const std::vector<T>& values) {
  Message m;
  for (const std::int64_t d : shape) m.number(kDims, d);
  return m.number(kDataType, type)
      .text(kTensorName, name)
      .text(kRaw, Message::little_endian(values.data(), values.size()));
}

}  // namespace

void OnnxGraph::input(const std::string& name, const std::vector<std::int64_t>& shape,
                      const std::string& meaning) {
  graph_.message(kInput, batch_of(name, shape, meaning));
}

void OnnxGraph::output(const std::string& name, const std::vector<std::int64_t>& shape,
                       const std::string& meaning) {
  graph_.message(kOutput, batch_of(name, shape, meaning));
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

void OnnxGraph::remark(const std::string& key, const std::string& value) {
  remarks_.message(kMetadata, Message().text(kKey, key).text(kValue, value));
}

std::string OnnxGraph::bytes() const {
  Message graph = graph_;
  graph.text(kGraphName, "hbr");
  return Message()
      .number(kIrVersion, kIr)
      .text(kProducer, "hbr")
      .message(kGraph, graph)
      .message(kOperatorSets, Message().text(1, "").number(2, kOperatorSet))
      .copy(remarks_.bytes())
      .bytes();
}

}  // namespace hbr::inline onnx
