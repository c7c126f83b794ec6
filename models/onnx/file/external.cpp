#include "models/onnx/file/external.h"

#include <algorithm>
#include <charconv>
#include <fstream>

#include "models/onnx/file/schema.h"
#include "models/onnx/file/shown.h"
#include "pipeline/core/check.h"

namespace hbr::inline onnx {
namespace {

std::uint64_t number_of_bytes(const std::string& key, const std::string& text) {
  std::uint64_t value = 0;
  const char* end = text.data() + text.size();
  if (const auto [stop, error] = std::from_chars(text.data(), end, value);
      error != std::errc() || stop != end)
    throw InputError("weights in another file: {} = '{}'; expected a number of bytes", key, shown(text));
  return value;
}

}  // namespace

void ExternalData::add(const Field& entry) {
  std::string key, value;
  Field field;
  for (FieldReader fields(entry.bytes); fields.next(field);)
    if (field.number == onnx::kKey)
      key = field.bytes;
    else if (field.number == onnx::kValue)
      value = field.bytes;
  if (key == "location")
    location = value;
  else if (key == "offset")
    offset = number_of_bytes(key, value);
  else if (key == "length")
    length = number_of_bytes(key, value);
}

bool ExternalData::is_inside() const {
  const std::filesystem::path path(location);
  return !location.empty() && path.is_relative() && location.find('\0') == std::string::npos &&
         std::find(path.begin(), path.end(), "..") == path.end();
}

std::string ExternalData::read(const std::filesystem::path& folder, const std::string& name,
                               std::uint64_t expected) const {
  if (!is_inside())
    throw InputError("its weights '{}' are in the file '{}'; expected a file in the network's own folder",
                     shown(name), shown(location));
  const std::filesystem::path path = folder / location;
  std::error_code none;
  if (!exists(path, none))
    throw InputError(
        "its weights '{}' are in another file, which is missing: {}; put it there, or export "
        "the network with its weights inside",
        shown(name), shown(path.string()));
  const std::uint64_t size = is_regular_file(path, none) ? file_size(path, none) : 0;
  const std::uint64_t count = length.value_or(expected);
  if (count != expected)
    throw InputError("its weights '{}' are {} bytes of {}; their shape and type need {}", shown(name), count,
                     shown(path.string()), expected);
  if (offset > size || count > size - offset)
    throw InputError(
        "its weights '{}' are {} bytes from byte {} on of {}, which has {} bytes; is it the "
        "file that was exported with this network?",
        shown(name), count, offset, shown(path.string()), size);
  std::string bytes(count, '\0');
  std::ifstream stream(path, std::ios::binary);
  stream.seekg(static_cast<std::streamoff>(offset));
  if (!stream.read(bytes.data(), static_cast<std::streamsize>(count)))
    throw InputError("its weights '{}': can't read {}", shown(name), shown(path.string()));
  return bytes;
}

}  // namespace hbr::inline onnx
