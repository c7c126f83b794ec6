// IDX, the file format of MNIST: a big-endian magic number (two zero bytes, the element type, the number of
// dimensions), the sizes, the elements.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace hbr::inline dataset {

struct Idx {
  std::filesystem::path path;  // the file that was read
  std::vector<std::size_t> shape;
  std::vector<std::uint8_t> values;  // row-major
};

// Reads bytes of `dimensions` dimensions from `file` or, where that is missing, from `file`.gz. sha256 is
// that of the unpacked content, in hexadecimal; empty: not checked. Throws InputError, naming the file, for
// one that is missing, unreadable, of another hash, type or number of dimensions, or whose length is not what
// its sizes say. Reads and unpacks no more than these sizes promise.
Idx read_idx(const std::filesystem::path& file, std::size_t dimensions, const std::string& sha256);

}  // namespace hbr::inline dataset
