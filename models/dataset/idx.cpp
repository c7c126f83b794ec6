#include "models/dataset/idx.h"

#include <fmt/ranges.h>
#include <openssl/evp.h>
#include <zlib.h>

#include <array>
#include <memory>

#include "pipeline/core/check.h"

namespace hbr {
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

// zlib reads a file that is not packed as it is.
std::vector<std::uint8_t> content(const fs::path& path) {
  const std::unique_ptr<gzFile_s, decltype(&gzclose_r)> file(gzopen(path.c_str(), "rb"), gzclose_r);
  if (!file) throw InputError("{}: can't be read", path.string());
  std::vector<std::uint8_t> bytes;
  constexpr unsigned kBlock = 1 << 20;
  for (;;) {
    const std::size_t before = bytes.size();
    bytes.resize(before + kBlock);
    const int read = gzread(file.get(), &bytes[before], kBlock);
    int error = Z_OK;
    const char* why = gzerror(file.get(), &error);
    if (read < 0 || (error != Z_OK && error != Z_STREAM_END))
      throw InputError("{}: can't be read or unpacked ({}); fetch it again", path.string(), why);
    bytes.resize(before + static_cast<unsigned>(read));
    if (read == 0) return bytes;
  }
}

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

}  // namespace

Idx read_idx(const fs::path& file, std::size_t dimensions, const std::string& sha256) {
  Idx idx;
  idx.path = plain_or_packed(file);
  const std::string name = idx.path.string();
  std::vector<std::uint8_t> bytes = content(idx.path);
  if (!sha256.empty())
    if (const std::string found = sha256_of(bytes); found != sha256)
      throw InputError(
          "{}: expected sha256 {}, found {} ({} bytes): if it is damaged, fetch it again; if it is of "
          "another "
          "dataset, say so in the profile: under [dataset] its name, and sha256 = []",
          name, sha256, found, bytes.size());

  const std::size_t header = 4 + 4 * dimensions, expected_magic = 0x0800 + dimensions;
  if (bytes.size() < header)
    throw InputError("{}: too short: expected at least {} bytes, found {}", name, header, bytes.size());
  if (const std::size_t magic = big_endian(bytes.data()); magic != expected_magic)
    throw InputError(
        "{}: not an IDX file of bytes with {} dimensions: expected magic number {:#010x}, found {:#010x}",
        name, dimensions, expected_magic, magic);
  // No product of sizes may overflow: divide what is there instead.
  std::size_t count = 1;
  bool fits = true;
  for (std::size_t d = 0; d < dimensions; ++d) {
    const std::size_t size = big_endian(&bytes[4 + 4 * d]);
    idx.shape.push_back(size);
    fits = fits && (size == 0 || count <= bytes.size() / size);
    count *= fits ? size : 1;
  }
  if (!fits || bytes.size() != header + count)
    throw InputError("{}: its length is not what its sizes say: expected {} bytes after the header, found {}",
                     name, fmt::join(idx.shape, " x "), bytes.size() - header);
  bytes.erase(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(header));
  idx.values = std::move(bytes);
  return idx;
}

}  // namespace hbr
