#include "reports/external.h"

#include <spawn.h>
#include <sys/wait.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "pipeline/core/check.h"

extern char** environ;

namespace hbr {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

// Unnamed files rather than pipes: no program can block on a full pipe that nobody reads.
File temporary_file() {
  File file(std::tmpfile());
  if (!file) throw InputError("no temporary file can be made: {}; is the disk full?", std::strerror(errno));
  return file;
}

std::string content(std::FILE* file) {
  std::string text;
  std::rewind(file);
  char block[65536];
  while (const std::size_t n = std::fread(block, 1, sizeof block, file)) text.append(block, n);
  return text;
}

std::vector<std::string> environment() {
  std::vector<std::string> variables;
  for (char** v = environ; *v; ++v) {
    const std::string text = *v;
    const bool ours = text.starts_with("LC_") || text.starts_with("LANG") ||
                      text.starts_with("SOURCE_DATE_EPOCH=") || text.starts_with("GNUPLOT");
    if (!ours) variables.push_back(text);
  }
  // C.UTF-8 is part of libc: it needs no locales package.
  variables.insert(variables.end(), {"LC_ALL=C.UTF-8", "SOURCE_DATE_EPOCH=0"});
  return variables;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> result;
  for (std::string& text : texts) result.push_back(text.data());
  result.push_back(nullptr);
  return result;
}

}  // namespace

std::string run_program(const std::vector<std::string>& command, const std::string& input) {
  HBR_CHECK(!command.empty(), "no program to run");
  const File in = temporary_file(), out = temporary_file(), error = temporary_file();
  if (std::fwrite(input.data(), 1, input.size(), in.get()) != input.size() || std::fflush(in.get()) != 0)
    throw InputError("cannot write the input of {}: {}; is the disk full?", command[0], std::strerror(errno));
  std::rewind(in.get());

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, fileno(in.get()), 0);
  posix_spawn_file_actions_adddup2(&actions, fileno(out.get()), 1);
  posix_spawn_file_actions_adddup2(&actions, fileno(error.get()), 2);
  std::vector<std::string> arguments = command, variables = environment();
  pid_t pid = 0;
  const int failed = posix_spawnp(&pid, arguments[0].c_str(), &actions, nullptr, pointers(arguments).data(),
                                  pointers(variables).data());
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0)
    throw InputError("cannot start {}: {}; is it installed?", command[0], std::strerror(failed));

  int status = 0;
  while (waitpid(pid, &status, 0) < 0)
    if (errno != EINTR) throw InputError("lost sight of {}: {}", command[0], std::strerror(errno));
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    const std::string how = WIFEXITED(status) ? fmt::format("failed with exit code {}", WEXITSTATUS(status))
                                              : fmt::format("was ended by signal {}", WTERMSIG(status));
    std::string said = content(error.get());
    for (char& c : said)
      if (c == '\n') c = ' ';
    throw InputError("{} {}: {}", command[0], how, said.empty() ? "it said nothing" : said);
  }
  return content(out.get());
}

}  // namespace hbr
