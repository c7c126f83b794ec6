#include "pipeline/artifact/version.h"

#include <fstream>
#include <string_view>
#include <vector>

#include "pipeline/core/check.h"
#include "pipeline/process/output.h"

namespace hbr::inline artifact {
namespace {

namespace fs = std::filesystem;

// The first line that a program prints; empty where it can't be started or fails.
std::string first_line(const std::vector<std::string>& command) {
  try {
    const Output output = output_of({command});
    return output.ending.exit_code == 0 ? output.text.substr(0, output.text.find('\n')) : "";
  } catch (const InputError&) {
    return "";
  }
}

// "1.0.0"; empty where the file is not or does not say.
std::string release_in(const fs::path& citation) {
  constexpr std::string_view key = "version: ";
  std::ifstream file(citation);
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with(key)) return line.substr(key.size());
  }
  return "";
}

// Empty where git has not put one in, which it does when it makes an archive.
std::string archived_commit(const fs::path& file) {
  std::string commit;
  std::ifstream(file) >> commit;
  return commit.starts_with('$') ? "" : commit;
}

// What the first of them says.
std::string first_of(const std::string& one, const std::string& other) { return one.empty() ? other : one; }

}  // namespace

std::string version_of(const fs::path& repository) {
  // The folder of git's own is named, so that none further up is found, and whoever owns it.
  const std::string commit =
      first_line({"git", "--git-dir=" + (repository / ".git").string(), "--work-tree=" + repository.string(),
                  "describe", "--always", "--dirty", "--exclude", "*"});
  return first_of(release_in(repository / "CITATION.cff"), "unknown") + '+' +
         first_of(first_of(commit, archived_commit(repository / ".version")), "unknown");
}

}  // namespace hbr::inline artifact
