// Weights as an ONNX file stores them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "models/onnx/file/external.h"
#include "models/onnx/file/message.h"

namespace hbr::inline onnx {

// A TensorProto: its parts that matter here, and all other fields as they stand.
struct StoredTensor {
  std::string name;
  std::int64_t type = 0;  // onnx::DataType
  std::vector<std::int64_t> dims;
  std::optional<std::string_view> raw;
  std::vector<std::int64_t> integers;  // int32_data, int64_data or uint64_data
  std::string floats, doubles;         // packed
  bool elsewhere = false;
  ExternalData external;
  Message others;

  // Throws InputError where the shape is one of more than 2 GB.
  std::uint64_t count() const;
  // Bytes of one number; 0 of a type that is not read.
  std::uint64_t size() const;
  // Throws InputError where the numbers here are more or fewer than the shape says.
  void check_count() const;
  // Of float16, bfloat16 and double here: as they stand in raw data.
  std::string unpacked() const;
};

StoredTensor read_tensor(std::string_view bytes);

constexpr std::uint64_t kMaxWeightBytes = 0x7fffffff;  // protobuf's own limit

// Whether numbers of this type are real and no float32, and such numbers as float32.
bool is_converted(std::int64_t type);
std::string to_floats(std::int64_t type, std::string_view raw);

}  // namespace hbr::inline onnx
