#include "models/dataset/idx.h"

#include <fmt/ranges.h>
#include <openssl/evp.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <limits>
#include <memory>
#include <optional>

#include "pipeline/core/check.h"
#include "pipeline/core/file_error.h"

namespace hbr::inline dataset {
namespace {

namespace fs = std::filesystem;

fs::path plain_or_packed(const fs::path& file) {
  fs::path packed = file;
  packed += ".gz";
  std::error_code ignored;
  for (const fs::path& path : {file, packed})
    if (fs::is_regular_file(path, ignored)) return path;
  throw InputError("{}: missing (nor is there a .gz of it); give a folder that holds it", file.string());
}

// A file, unpacked where it is packed: zlib reads one that is not as it is.
class Unpacked {
 public:
  explicit Unpacked(const fs::path& path) : path_(path), file_(gzopen(path.c_str(), "rb"), gzclose_r) {
    if (!file_) throw file_error(path_, "can't read", errno);
  }
  // Reads on until `bytes` has that size, or the file has ended. Room is made as it is needed: a size may be
  // a damaged header's.
  void read_to(std::size_t size, std::vector<std::uint8_t>& bytes) const {
    constexpr std::size_t kBlock = 1 << 20;
    while (bytes.size() < size) {
      const std::size_t before = bytes.size(), wanted = std::min(kBlock, size - before);
      bytes.resize(before + wanted);
      const int read = gzread(file_.get(), &bytes[before], static_cast<unsigned>(wanted));
      int error = Z_OK;
      const char* why = gzerror(file_.get(), &error);
      if (read < 0 || (error != Z_OK && error != Z_STREAM_END))
        throw InputError("{}: can't be read or unpacked ({}); fetch it again", path_.string(), why);
      bytes.resize(before + static_cast<unsigned>(read));
      if (read == 0) return;
    }
  }

 private:
  fs::path path_;
  std::unique_ptr<gzFile_s, decltype(&gzclose_r)> file_;
};

std::string sha256_of(const std::vector<std::uint8_t>& bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned size = 0;
  const int done = EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr);
  HBR_CHECK(done == 1, "EVP_Digest returned {}", done);
  return fmt::format("{:02x}", fmt::join(digest.begin(), digest.begin() + size, ""));
}

std::size_t big_endian(const std::uint8_t* bytes) {
  return std::size_t{bytes[0]} << 24 | std::size_t{bytes[1]} << 16 | std::size_t{bytes[2]} << 8 | bytes[3];
}

// Nothing where no file can hold so many bytes.
std::optional<std::size_t> product(const std::vector<std::size_t>& sizes) {
  constexpr std::size_t kMost = std::numeric_limits<std::ptrdiff_t>::max() / 2;
  if (std::find(sizes.begin(), sizes.end(), std::size_t{0}) != sizes.end()) return 0;
  std::size_t count = 1;
  for (const std::size_t size : sizes) {
    if (size > kMost / count) return {};
    count *= size;
  }
  return count;
}

}  // namespace

Idx read_idx(const fs::path& file, std::size_t dimensions, const std::string& sha256) {
  Idx idx;
  idx.path = plain_or_packed(file);
  const std::string name = idx.path.string();
  const Unpacked content(idx.path);
  std::vector<std::uint8_t> bytes;
  const std::size_t header = 4 + 4 * dimensions, expected_magic = 0x0800 + dimensions;
  content.read_to(header, bytes);
  const bool whole_header = bytes.size() == header;
  const auto other_length = [&](const std::string& found) {
    return InputError(
        "{}: its length is not what its header says: expected {} bytes after the header, found {}; fetch it "
        "again",
        name, fmt::join(idx.shape, " x "), found);
  };
  if (whole_header) {
    if (const std::size_t magic = big_endian(bytes.data()); magic != expected_magic)
      throw InputError(
          "{}: not an IDX file of bytes with {} dimensions: expected magic number {:#010x}, found {:#010x}; "
          "if it is damaged, fetch it again",
          name, dimensions, expected_magic, magic);
    for (std::size_t d = 0; d < dimensions; ++d) idx.shape.push_back(big_endian(&bytes[4 + 4 * d]));
    // A packed file of a few bytes may unpack to any length: no more is read than the header promises, and
    // one byte, which tells that there is more.
    const std::optional<std::size_t> promised = product(idx.shape);
    if (promised) content.read_to(header + *promised + 1, bytes);
    if (!promised || bytes.size() > header + *promised)
      throw other_length(promised ? "more" : "fewer: no file has as many");
  }
  if (!sha256.empty())
    if (const std::string found = sha256_of(bytes); found != sha256)
      throw InputError(
          "{}: expected sha256 {}, found {} ({} bytes): if it is damaged, fetch it again; if it is of "
          "another dataset, say so in the profile: under [dataset] its name, its folder, and sha256 = []",
          name, sha256, found, bytes.size());
  if (!whole_header)
    throw InputError("{}: too short: expected a header of {} bytes, found {} bytes in all; fetch it again",
                     name, header, bytes.size());
  if (bytes.size() < header + *product(idx.shape))
    throw other_length(fmt::format("{}", bytes.size() - header));
  bytes.erase(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(header));
  idx.values = std::move(bytes);
  return idx;
}

}  // namespace hbr::inline dataset
