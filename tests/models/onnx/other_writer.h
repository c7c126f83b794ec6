// ONNX files as other programs write them: a second writer of protobuf, which shares nothing with the
// project's own.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace hbr::other {

inline std::string varint(std::uint64_t v) {
  return v < 128 ? std::string(1, static_cast<char>(v)) : static_cast<char>(128 + v % 128) + varint(v / 128);
}
inline std::string number(int field, std::int64_t v) {
  return varint(static_cast<std::uint64_t>(field) * 8) + varint(static_cast<std::uint64_t>(v));
}
inline std::string bytes(int field, const std::string& v) {
  return varint(static_cast<std::uint64_t>(field) * 8 + 2) + varint(v.size()) + v;
}
template <class T>
std::string raw(const std::vector<T>& values) {
  std::string all(values.size() * sizeof(T), '\0');
  std::memcpy(all.data(), values.data(), all.size());
  return all;
}

// A TensorProto. `data`: its fields that hold the numbers.
inline std::string tensor(const std::string& name, int type, const std::vector<int>& dims,
                          const std::string& data) {
  std::string all;
  for (const int d : dims) all += number(1, d);
  return all + number(2, type) + data + bytes(8, name);
}
inline std::string raw_data(const std::string& v) { return bytes(9, v); }
inline std::string entry(const std::string& key, const std::string& value) {
  return bytes(13, bytes(1, key) + bytes(2, value));
}
// Data that is elsewhere; offset and length as text, "" to leave them out.
inline std::string in_file(const std::string& location, const std::string& offset,
                           const std::string& length) {
  return entry("location", location) + (offset.empty() ? "" : entry("offset", offset)) +
         (length.empty() ? "" : entry("length", length)) + number(14, 1);
}

inline std::string integer_attribute(const std::string& name, std::int64_t v) {
  return bytes(5, bytes(1, name) + number(3, v) + number(20, 2));
}
inline std::string integers_attribute(const std::string& name, const std::vector<int>& all) {
  std::string packed;
  for (const int v : all) packed += varint(static_cast<std::uint64_t>(static_cast<std::int64_t>(v)));
  return bytes(5, bytes(1, name) + bytes(8, packed) + number(20, 7));
}
inline std::string tensor_attribute(const std::string& name, const std::string& tensor) {
  return bytes(5, bytes(1, name) + bytes(5, tensor) + number(20, 4));
}

constexpr int kFloat = 1, kInt64 = 7, kFloat16 = 10, kDouble = 11, kBfloat16 = 16;

// A graph, put together in the order of its nodes.
struct File {
  // A size below 0 is open and has a name, one of 0 is open and has none.
  File& input(const std::string& name, const std::vector<int>& dims, int type = kFloat) {
    graph += bytes(11, value(name, dims, type));
    return *this;
  }
  File& input_without_shape(const std::string& name) {
    graph += bytes(11, bytes(1, name) + bytes(2, bytes(1, number(1, kFloat))));
    return *this;
  }
  File& output(const std::string& name, const std::vector<int>& dims, int type = kFloat) {
    graph += bytes(12, value(name, dims, type));
    return *this;
  }
  File& weights(const std::string& tensor) {
    graph += bytes(5, tensor);
    return *this;
  }
  File& floats(const std::string& name, const std::vector<int>& dims, const std::vector<float>& values) {
    return weights(tensor(name, kFloat, dims, raw_data(raw(values))));
  }
  File& node(const std::string& operation, const std::vector<std::string>& inputs,
             const std::vector<std::string>& outputs, const std::string& attributes = "",
             const std::string& domain = "") {
    std::string all;
    for (const std::string& in : inputs) all += bytes(1, in);
    for (const std::string& out : outputs) all += bytes(2, out);
    all += bytes(3, "/" + outputs.front() + "/" + operation) + bytes(4, operation) + attributes;
    if (!domain.empty()) all += bytes(7, domain);
    graph += bytes(1, all);
    return *this;
  }
  std::string content() const {
    return number(1, 8) + bytes(2, "another") + bytes(3, "2.1.0") + bytes(7, bytes(2, "main_graph") + graph) +
           bytes(8, bytes(1, "") + number(2, 13));
  }

  static std::string value(const std::string& name, const std::vector<int>& dims, int type) {
    std::string shape;
    for (const int d : dims) shape += bytes(1, d > 0 ? number(1, d) : d < 0 ? bytes(2, "batch") : "");
    return bytes(1, name) + bytes(2, bytes(1, number(1, type) + bytes(2, shape)));
  }

  std::string graph;
};

}  // namespace hbr::other
