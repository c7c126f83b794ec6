// Writes protobuf's wire format (protobuf.dev/programming-guides/encoding), as much of it as ONNX files need.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace hbr::inline onnx {

class Message {
 public:
  Message& number(int field, std::int64_t value) {
    key(field, 0);
    varint(static_cast<std::uint64_t>(value));
    return *this;
  }
  Message& real(int field, float value) {
    key(field, 5);
    bytes_.append(little_endian(&value, 1));
    return *this;
  }
  Message& text(int field, std::string_view value) {
    key(field, 2);
    varint(value.size());
    bytes_.append(value);
    return *this;
  }
  Message& message(int field, const Message& value) { return text(field, value.bytes_); }
  // Appends fields as they stand in another message.
  Message& copy(std::string_view fields) {
    bytes_.append(fields);
    return *this;
  }

  const std::string& bytes() const { return bytes_; }

  // How numbers of four and eight bytes stand in a file; all machines we build for keep them so.
  template <class T>
  static std::string_view little_endian(const T* values, std::size_t n) {
    return {reinterpret_cast<const char*>(values), n * sizeof(T)};
  }

 private:
  void key(int field, unsigned wire_type) { varint(static_cast<unsigned>(field) << 3 | wire_type); }
  void varint(std::uint64_t value) {
    for (; value > 127; value >>= 7) bytes_ += static_cast<char>(value | 128);
    bytes_ += static_cast<char>(value);
  }

  std::string bytes_;
};

}  // namespace hbr::inline onnx
