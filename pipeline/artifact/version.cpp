#include "pipeline/artifact/version.h"

#include <fstream>
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

// The description, or where no tag is near the commit; git puts them in when it makes an archive.
std::string archived(const fs::path& file) {
  std::string version;
  std::ifstream(file) >> version;
  return version.starts_with('$') ? "" : version;
}

}  // namespace

std::string version_of(const fs::path& repository) {
  // The folder of git's own is named, so that none further up is found, and whoever owns it.
  const std::string version =
      first_line({"git", "--git-dir=" + (repository / ".git").string(), "--work-tree=" + repository.string(),
                  "describe", "--always", "--dirty", "--tags"});
  if (!version.empty()) return version;
  const std::string told = archived(repository / ".version");
  return told.empty() ? "unknown" : told;
}

}  // namespace hbr::inline artifact
