#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "pipeline/core/check.h"
#include "tests/fuzz/fuzz.h"

namespace hbr::fuzz {
namespace {

void expect_one_line(const std::string& complaint) {
  if (!complaint.empty() && complaint.find('\n') == std::string::npos) return;
  std::fprintf(stderr, "a complaint is not one line: '%s'\n", complaint.c_str());
  std::abort();
}

}  // namespace

void and_go_on(const std::function<void()>& part) {
  try {
    part();
  } catch (const InputError& error) {
    expect_one_line(error.what());
  }
}

const std::filesystem::path& folder() {
  struct Folder {
    Folder() : path(std::filesystem::temp_directory_path() / fmt::format("hbr-fuzz-{}", ::getpid())) {
      std::filesystem::create_directories(path);
    }
    ~Folder() {
      if (::getpid() == owner) std::filesystem::remove_all(path);  // and no child of it
    }
    pid_t owner = ::getpid();
    std::filesystem::path path;
  };
  static const Folder folder;
  return folder.path;
}

std::filesystem::path written(const std::string& name, const std::string& bytes) {
  std::ofstream(folder() / name, std::ios::binary) << bytes;
  return folder() / name;
}

std::string content_of_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  HBR_CHECK(file.good(), "{}", path.string());
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace hbr::fuzz

// Puts the examples into the corpus, which is the first argument that is no option.
extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  for (int i = 1; i < *argc; ++i) {
    const std::filesystem::path corpus = (*argv)[i];
    if (!std::filesystem::is_directory(corpus)) continue;
    int number = 0;
    for (const std::string& bytes : hbr::fuzz::examples())
      std::ofstream(corpus / fmt::format("example-{}", number++), std::ios::binary) << bytes;
    break;
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    hbr::fuzz::and_go_on([&] { hbr::fuzz::read({reinterpret_cast<const char*>(data), size}); });
  } catch (const std::exception& error) {
    std::fprintf(stderr, "no InputError: %s\n", error.what());
    std::abort();
  }
  return 0;
}
