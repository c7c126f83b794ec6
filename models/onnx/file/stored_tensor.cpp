#include "models/onnx/file/stored_tensor.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "models/onnx/file/fields.h"
#include "models/onnx/file/schema.h"
#include "models/onnx/file/shown.h"
#include "pipeline/core/check.h"

namespace hbr::inline onnx {
namespace {

float from_half(std::uint16_t half) {
  const unsigned exponent = half >> 10 & 31, fraction = half & 1023;
  float value = std::ldexp(static_cast<float>(fraction | (exponent ? 1024 : 0)),
                           static_cast<int>(exponent ? exponent : 1) - 25);
  if (exponent == 31)
    value = fraction ? std::numeric_limits<float>::quiet_NaN() : std::numeric_limits<float>::infinity();
  return half >> 15 ? -value : value;
}

float from_bfloat(std::uint16_t half) { return std::bit_cast<float>(static_cast<std::uint32_t>(half) << 16); }

template <class From>
std::string converted(std::string_view raw, float (*convert)(From)) {
  std::string floats;
  for (std::size_t i = 0; i < raw.size(); i += sizeof(From)) {
    From number;
    std::memcpy(&number, &raw[i], sizeof number);
    const float value = convert(number);
    floats.append(Message::little_endian(&value, 1));
  }
  return floats;
}

}  // namespace

std::uint64_t StoredTensor::count() const {
  std::uint64_t all = 1;
  for (const std::int64_t d : dims) {
    if (d < 0 || (d > 0 && all > kMaxWeightBytes / static_cast<std::uint64_t>(d)))
      throw InputError("its weights '{}' have a shape of more than 2 GB", shown(name));
    all *= static_cast<std::uint64_t>(d);
  }
  return all;
}

std::uint64_t StoredTensor::size() const {
  switch (type) {
    case onnx::kUint8:
    case onnx::kInt8:
    case onnx::kBool:
      return 1;
    case onnx::kUint16:
    case onnx::kInt16:
    case onnx::kFloat16:
    case onnx::kBfloat16:
      return 2;
    case onnx::kFloat:
    case onnx::kInt32:
    case onnx::kUint32:
      return 4;
    case onnx::kInt64:
    case onnx::kUint64:
    case onnx::kDouble:
      return 8;
    default:
      return 0;
  }
}

void StoredTensor::check_count() const {
  const std::uint64_t found = raw                     ? raw->size()
                              : type == onnx::kFloat  ? floats.size()
                              : type == onnx::kDouble ? doubles.size()
                                                      : integers.size() * size();
  if (found != count() * size())
    throw InputError("its weights '{}' are {} bytes; their shape and type need {}", shown(name), found,
                     count() * size());
}

std::string StoredTensor::unpacked() const {
  if (raw) return std::string(*raw);
  std::string all = doubles;
  for (const std::int64_t number : integers) {
    const auto half = static_cast<std::uint16_t>(number);
    all.append(Message::little_endian(&half, 1));
  }
  return all;
}

StoredTensor read_tensor(std::string_view bytes) {
  StoredTensor t;
  Field f;
  for (FieldReader fields(bytes); fields.next(f);) switch (f.number) {
      case onnx::kDims:
        append_integers(f, t.dims);
        t.others.copy(f.whole);
        break;
      case onnx::kTensorName:
        t.name = f.bytes;
        t.others.copy(f.whole);
        break;
      case onnx::kDataType:
        t.type = static_cast<std::int64_t>(f.value);
        break;
      case onnx::kRaw:
        t.raw = f.bytes;
        break;
      case onnx::kFloats:
        t.floats += f.bytes;
        break;
      case onnx::kDoubles:
        t.doubles += f.bytes;
        break;
      case onnx::kInt32s:
      case onnx::kInt64s:
      case onnx::kUint64s:
        append_integers(f, t.integers);
        break;
      case onnx::kExternalData:
        t.external.add(f);
        break;
      case onnx::kDataLocation:
        t.elsewhere = f.value == 1;
        break;
      default:
        t.others.copy(f.whole);
    }
  return t;
}

bool is_converted(std::int64_t type) {
  return type == onnx::kFloat16 || type == onnx::kBfloat16 || type == onnx::kDouble;
}

std::string to_floats(std::int64_t type, std::string_view raw) {
  if (type == onnx::kFloat16) return converted<std::uint16_t>(raw, from_half);
  if (type == onnx::kBfloat16) return converted<std::uint16_t>(raw, from_bfloat);
  return converted<double>(raw, [](double number) { return static_cast<float>(number); });
}

}  // namespace hbr::inline onnx
