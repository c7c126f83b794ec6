// A command, as from a shell.
#pragma once

#include <sys/wait.h>

#include <cstdio>
#include <string>

namespace hbr {

struct ShellResult {
  int code = 0;      // the exit code; minus the signal that ended it
  std::string text;  // stdout and stderr
};

// Runs a line in bash; it has no single quotes in it.
inline ShellResult shell(const std::string& line) {
  ShellResult outcome;
  // Make's own variables would make the tests depend on how they were called.
  FILE* pipe = ::popen(("env -u MAKEFLAGS -u MAKELEVEL -u MFLAGS bash -c '" + line + "' 2>&1").c_str(), "r");
  char buffer[4096];
  while (const std::size_t got = std::fread(buffer, 1, sizeof buffer, pipe)) outcome.text.append(buffer, got);
  const int status = ::pclose(pipe);
  outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  return outcome;
}

}  // namespace hbr
