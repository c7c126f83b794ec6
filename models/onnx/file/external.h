// Where weights stand that are not in the ONNX file itself.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "models/onnx/file/fields.h"

namespace hbr::inline onnx {

struct ExternalData {
  std::string location;  // relative to the network's folder
  std::uint64_t offset = 0;
  std::optional<std::uint64_t> length;

  // Adds an entry of TensorProto.external_data. Throws InputError where a number is none.
  void add(const Field& entry);
  // Whether `location` stays in the folder.
  bool is_inside() const;
  // These bytes, `expected` of them, of the weights `name` of the network in `folder`.
  std::string read(const std::filesystem::path& folder, const std::string& name,
                   std::uint64_t expected) const;
};

}  // namespace hbr::inline onnx
