// Reads protobuf's wire format (protobuf.dev/programming-guides/encoding), field by field.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace hbr::inline onnx {

enum class WireType { varint = 0, eight_bytes = 1, length = 2, four_bytes = 5 };

struct Field {
  int number = 0;
  WireType type = WireType::varint;
  std::uint64_t value = 0;  // of a varint
  std::string_view bytes;   // of all other types
  std::string_view whole;   // with its key
};

class FieldReader {
 public:
  explicit FieldReader(std::string_view message) : rest_(message) {}
  // Whether there was another field. Throws InputError where the bytes are no message.
  bool next(Field& field);

 private:
  std::string_view rest_;
};

// Appends the integers of a repeated field, which stand one by one or packed.
void append_integers(const Field& field, std::vector<std::int64_t>& values);

}  // namespace hbr::inline onnx
