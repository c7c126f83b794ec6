#include "models/onnx/file/fields.h"

#include "pipeline/core/check.h"

namespace hbr::inline onnx {
namespace {

// Each takes what it reads off the front of `rest`.
std::string_view take(std::string_view& rest, std::uint64_t size) {
  if (size > rest.size()) throw InputError("not an ONNX network, or a damaged one: it ends within a field");
  const std::string_view taken = rest.substr(0, size);
  rest.remove_prefix(size);
  return taken;
}

std::uint64_t take_varint(std::string_view& rest) {
  std::uint64_t value = 0;
  for (unsigned shift = 0; shift < 64; shift += 7) {
    const auto byte = static_cast<unsigned char>(take(rest, 1)[0]);
    value |= static_cast<std::uint64_t>(byte & 127) << shift;
    if (byte < 128) return value;
  }
  throw InputError("not an ONNX network, or a damaged one: a number of more than 64 bits");
}

}  // namespace

bool FieldReader::next(Field& field) {
  if (rest_.empty()) return false;
  const std::string_view from = rest_;
  const std::uint64_t key = take_varint(rest_);
  field = {static_cast<int>(key >> 3 & 0x1fffffff), static_cast<WireType>(key & 7), 0, {}, {}};
  switch (field.type) {
    case WireType::varint:
      field.value = take_varint(rest_);
      break;
    case WireType::eight_bytes:
      field.bytes = take(rest_, 8);
      break;
    case WireType::length:
      field.bytes = take(rest_, take_varint(rest_));
      break;
    case WireType::four_bytes:
      field.bytes = take(rest_, 4);
      break;
    default:
      throw InputError("not an ONNX network, or a damaged one: a field of type {}", key & 7);
  }
  field.whole = from.substr(0, from.size() - rest_.size());
  return true;
}

void append_integers(const Field& field, std::vector<std::int64_t>& values) {
  if (field.type == WireType::varint) values.push_back(static_cast<std::int64_t>(field.value));
  for (std::string_view rest = field.bytes; !rest.empty();)
    values.push_back(static_cast<std::int64_t>(take_varint(rest)));
}

}  // namespace hbr::inline onnx
