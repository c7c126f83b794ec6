#include "pipeline/artifact/temporary.h"

#include <fmt/format.h>

#include <algorithm>

#include "pipeline/process/identity.h"

namespace hbr::inline artifact {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kPrefix = ".tmp-";

// Of the file, or of the folder or anything in it.
fs::file_time_type last_written(const fs::path& path) {
  fs::file_time_type last = fs::last_write_time(path);
  if (fs::is_directory(path))
    for (const auto& entry : fs::recursive_directory_iterator(path))
      last = std::max(last, entry.last_write_time());
  return last;
}

// A name that is not of this form is an older version's; nobody who writes such names is at work under the
// lock.
bool is_abandoned(const fs::path& path) {
  const std::string name = path.filename().string().substr(kPrefix.size());
  const std::optional<Process> process = process_of(name.substr(0, name.find('@', name.find('@') + 1)));
  if (!process) return true;
  if (process->host == this_host()) return !is_alive(*process);
  return fs::file_time_type::clock::now() - last_written(path) > kAbandonedAfter;
}

}  // namespace

fs::path temporary_beside(const fs::path& path, const std::string& mark) {
  return path.parent_path() / fmt::format("{}{}@{}{}", kPrefix, text_of(this_process()),
                                          mark.empty() ? "" : mark + "-", path.filename().string());
}

void remove_abandoned(const fs::path& folder) {
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().filename().string().starts_with(kPrefix) && is_abandoned(entry.path()))
      fs::remove_all(entry.path());
}

}  // namespace hbr::inline artifact
