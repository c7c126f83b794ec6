// What is being written, under hidden names beside what it becomes. They name their process, so that nobody
// removes what another is writing.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>

namespace hbr::inline artifact {

// FOLDER/.tmp-1234.56789@HOST@NAME, by this process. `mark` tells several for one path apart. The name of the
// path stands last, so that it keeps its ending.
std::filesystem::path temporary_beside(const std::filesystem::path& path, const std::string& mark = "");

// Removed with this, whatever happens, unless it became something else before.
struct Temporary {
  explicit Temporary(std::filesystem::path where) : path(std::move(where)) {}
  ~Temporary() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  Temporary(const Temporary&) = delete;
  const std::filesystem::path path;
};

constexpr std::chrono::hours kAbandonedAfter{1};

// Removes what processes that have ended left in the folder. Another host's processes can't be seen from
// here: theirs go when nothing was written to them for kAbandonedAfter.
void remove_abandoned(const std::filesystem::path& folder);

}  // namespace hbr::inline artifact
