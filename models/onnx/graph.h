// An ONNX model (onnx.ai, operator set 13, which OpenCV 4.6 and all later tools read), put together node by
// node. All inputs and outputs are batches: their first dimension is left open.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <variant>
#include <vector>

#include "models/onnx/file/message.h"

namespace hbr::inline onnx {

struct OnnxAttribute {
  std::string name;
  std::variant<std::int64_t, float, std::string, std::vector<std::int64_t>> value;
};

class OnnxGraph {
 public:
  // Shapes without the batch's dimension. `meaning` is for people.
  void input(const std::string& name, const std::vector<std::int64_t>& shape,
             const std::string& meaning = "");
  void output(const std::string& name, const std::vector<std::int64_t>& shape,
              const std::string& meaning = "");

  // What the file says of itself (metadata_props).
  void remark(const std::string& key, const std::string& value);

  // Constants that nodes take as inputs; values are row-major.
  void weights(const std::string& name, const std::vector<std::int64_t>& shape,
               const std::vector<float>& values);
  void numbers(const std::string& name, const std::vector<std::int64_t>& values);

  // Adds an operation that makes the value `output`; in the order of execution. "" stands for an optional
  // input left out.
  void node(const std::string& operation, const std::vector<std::string>& inputs, const std::string& output,
            const std::vector<OnnxAttribute>& attributes = {});

  // The file's content; equal graphs give equal bytes.
  std::string bytes() const;

 private:
  Message graph_, remarks_;
};

}  // namespace hbr::inline onnx
