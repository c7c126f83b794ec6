#include "pipeline/artifact/version.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <fstream>
#include <vector>

namespace hbr {
namespace {

namespace fs = std::filesystem;

// The first line that a program prints; empty where it can't be started or fails.
std::string first_line(std::vector<std::string> command) {
  std::vector<char*> words;
  for (std::string& word : command) words.push_back(word.data());
  words.push_back(nullptr);
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) return "";
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const bool started = ::posix_spawnp(&child, words[0], &actions, nullptr, words.data(), environ) == 0;
  posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  std::string text;
  std::array<char, 256> part;
  while (started) {
    const ssize_t got = ::read(ends[0], part.data(), part.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    text.append(part.data(), static_cast<std::size_t>(got));
  }
  ::close(ends[0]);
  int status = -1;
  while (started && ::waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  return status == 0 ? text.substr(0, text.find('\n')) : "";
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

}  // namespace hbr
