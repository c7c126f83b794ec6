#include "pipeline/artifact/content.h"

#include <elf.h>
#include <fcntl.h>
#include <openssl/evp.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

#include "pipeline/artifact/temporary.h"
#include "pipeline/core/file_error.h"

namespace hbr::inline artifact {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void fail(const fs::path& path, const char* what) { throw file_error(path, what, errno); }

[[noreturn]] void no_file(const fs::path& path) {
  throw InputError("{}: expected a file or a folder, found something else", path.string());
}

class Sha256 {
 public:
  Sha256() : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
    EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr);
  }
  void add(const void* data, std::size_t bytes) { EVP_DigestUpdate(context_.get(), data, bytes); }
  std::string hex() {
    std::array<unsigned char, 32> digest{};
    EVP_DigestFinal_ex(context_.get(), digest.data(), nullptr);
    return fmt::format("{:02x}", fmt::join(digest, ""));
  }

 private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

// Few calls, and few pages of memory that have never been touched.
constexpr std::size_t kReadAtOnce = std::size_t{1} << 18;

class Descriptor {
 public:
  Descriptor(const fs::path& path, int flags)
      // Not blocking: a pipe that nobody writes to would be waited for without end.
      : path_(path), id_(::open(path.c_str(), flags | O_CLOEXEC | O_NONBLOCK, 0666)) {
    if (id_ < 0) fail(path, flags == O_RDONLY ? "can't read" : "can't write");
    struct stat s {};
    if (::fstat(id_, &s) == 0 && (S_ISREG(s.st_mode) || S_ISDIR(s.st_mode))) return;
    ::close(id_);
    no_file(path);
  }
  ~Descriptor() {
    if (id_ >= 0) ::close(id_);
  }
  Descriptor(const Descriptor&) = delete;
  std::size_t read(char* to, std::size_t bytes) const {
    ssize_t got;
    while ((got = ::read(id_, to, bytes)) < 0)
      if (errno != EINTR) fail(path_, "can't read");
    return static_cast<std::size_t>(got);
  }
  // Whether there are so many.
  bool read_at(std::uint64_t offset, void* to, std::size_t bytes) const {
    for (std::size_t done = 0; done < bytes;) {
      const ssize_t got =
          ::pread(id_, static_cast<char*>(to) + done, bytes - done, static_cast<off_t>(offset + done));
      if (got < 0 && errno != EINTR) fail(path_, "can't read");
      if (got == 0) return false;
      if (got > 0) done += static_cast<std::size_t>(got);
    }
    return true;
  }
  void write(std::string_view text) const {
    while (!text.empty()) {
      const ssize_t written = ::write(id_, text.data(), text.size());
      if (written < 0 && errno != EINTR) fail(path_, "can't write");
      if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
    }
  }
  void sync() const {
    // A file system without fsync says EINVAL; there is nothing more to do then.
    if (::fsync(id_) != 0 && errno != EINVAL) fail(path_, "can't write through to the disk");
  }
  // A network's server may say only now that its disk is full.
  void close() {
    if (::close(std::exchange(id_, -1)) != 0) fail(path_, "can't write");
  }

 private:
  fs::path path_;
  int id_;
};

std::string sha256_of_file(const fs::path& path, std::uint64_t& bytes) {
  const Descriptor file(path, O_RDONLY);
  Sha256 hash;
  std::vector<char> buffer(kReadAtOnce);
  while (const std::size_t got = file.read(buffer.data(), buffer.size())) {
    hash.add(buffer.data(), got);
    bytes += got;
  }
  return hash.hex();
}

// Paths below the folder, sorted.
std::vector<fs::path> files_below(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_directory() && !entry.is_symlink()) continue;
    if (!entry.is_regular_file() || entry.is_symlink()) no_file(entry.path());
    files.push_back(entry.path().lexically_relative(folder));
  }
  std::sort(files.begin(), files.end());
  return files;
}

// What std::filesystem throws, as all errors of files are told.
template <class Look>
auto looked_at(Look&& look) {
  try {
    return look();
  } catch (const fs::filesystem_error& error) {
    throw file_error(error);
  }
}

std::string fingerprint_of_file(const fs::path& path) {
  struct stat s {};
  if (::stat(path.c_str(), &s) != 0) return "";
  return fmt::format("{} {}.{:09} {}.{:09} {}", s.st_size, s.st_mtim.tv_sec, s.st_mtim.tv_nsec,
                     s.st_ctim.tv_sec, s.st_ctim.tv_nsec, s.st_ino);
}

}  // namespace

std::string sha256_of_text(std::string_view text) {
  Sha256 hash;
  hash.add(text.data(), text.size());
  return hash.hex();
}

Content content_of(const fs::path& path) {
  return looked_at([&] {
    Content content;
    if (!fs::is_directory(path)) {
      content.sha256 = sha256_of_file(path, content.bytes);
      return content;
    }
    std::string list;
    for (const fs::path& file : files_below(path)) {
      const std::string hash = sha256_of_file(path / file, content.bytes);
      content.files[file.string()] = hash;
      list += hash + "  " + file.string() + "\n";
    }
    content.sha256 = sha256_of_text(list);
    return content;
  });
}

std::string sha256_of_program(const fs::path& path) {
  const Descriptor file(path, O_RDONLY);
  Elf64_Ehdr header;
  if (!file.read_at(0, &header, sizeof header) || std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0) {
    std::uint64_t bytes = 0;
    return sha256_of_file(path, bytes);
  }
  const auto read = [&](std::uint64_t at, void* to, std::size_t bytes) {
    if (!file.read_at(at, to, bytes)) throw InputError("{}: this program is cut short", path.string());
  };
  std::vector<Elf64_Phdr> segments(header.e_phnum);
  read(header.e_phoff, segments.data(), segments.size() * sizeof(Elf64_Phdr));
  // Where the sections are, debug information among them, stands in the header, which is in the first
  // segment.
  header.e_shoff = 0;
  header.e_shnum = header.e_shstrndx = 0;
  Sha256 hash;
  std::vector<char> buffer(kReadAtOnce);
  for (const Elf64_Phdr& segment : segments) {
    if (segment.p_type != PT_LOAD) continue;
    for (std::uint64_t done = 0, bytes; done < segment.p_filesz; done += bytes) {
      bytes = std::min<std::uint64_t>(buffer.size(), segment.p_filesz - done);
      read(segment.p_offset + done, buffer.data(), bytes);
      if (segment.p_offset + done == 0 && bytes >= sizeof header)
        std::memcpy(buffer.data(), &header, sizeof header);
      hash.add(buffer.data(), bytes);
    }
  }
  return hash.hex();
}

std::string fingerprint(const fs::path& path) {
  return looked_at([&] {
    if (!fs::is_directory(path)) return fingerprint_of_file(path);
    std::string list;
    for (const fs::path& file : files_below(path))
      list += fingerprint_of_file(path / file) + "  " + file.string() + "\n";
    return sha256_of_text(list);
  });
}

void sync_to_disk(const fs::path& path) {
  if (fs::is_directory(path))
    for (const fs::path& file : files_below(path)) Descriptor(path / file, O_RDONLY).sync();
  Descriptor(path, O_RDONLY).sync();
}

std::string read_whole(const fs::path& path) {
  const Descriptor file(path, O_RDONLY);
  std::string all;
  std::vector<char> buffer(std::size_t{1} << 16);
  while (const std::size_t got = file.read(buffer.data(), buffer.size())) all.append(buffer.data(), got);
  return all;
}

void write_file(const fs::path& path, std::string_view text) {
  Descriptor file(path, O_WRONLY | O_CREAT | O_TRUNC);
  file.write(text);
  file.close();
}

void write_whole(const fs::path& path, std::string_view text) {
  const fs::path temporary = temporary_beside(path);
  try {
    Descriptor file(temporary, O_WRONLY | O_CREAT | O_TRUNC);
    file.write(text);
    file.sync();
    file.close();
    if (::rename(temporary.c_str(), path.c_str()) != 0) fail(path, "can't write");
  } catch (const InputError&) {
    ::unlink(temporary.c_str());
    throw;
  }
}

}  // namespace hbr::inline artifact
