#include "pipeline/artifact/launch.h"

#include <fmt/format.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "pipeline/artifact/program.h"
#include "pipeline/core/check.h"
#include "pipeline/core/memory_limit.h"

namespace hbr::inline artifact {
namespace {

// What a user can do, where the signal alone tells.
const char* remedy_of(int signal) {
  return signal == SIGILL ? "; built for another processor: build it there, or with HBR_ARCH=x86-64-v3" : "";
}

}  // namespace

std::vector<std::string> launched(const std::string& launch, const std::vector<std::string>& command) {
  if (launch.empty()) return command;
  std::vector<std::string> words{"/bin/sh", "-c", fmt::format("exec {} \"$@\"", launch), "sh"};
  words.insert(words.end(), command.begin(), command.end());
  return words;
}

void tell_launcher(const std::string& job, int threads, const Request& request) {
  ::setenv("HBR_JOB", job.c_str(), 1);
  ::setenv("HBR_THREADS", std::to_string(threads).c_str(), 1);
  ::setenv("HBR_SECONDS", std::to_string(request.seconds).c_str(), 1);
  ::setenv("HBR_MEMORY_MB", std::to_string(request.memory_mb).c_str(), 1);
}

bool is_refusal(const ChildResult& child, const std::optional<RunRecord>& record, const std::string& launch) {
  // A launcher's own 2 means something else.
  return record ? record->exit_code == 2 : launch.empty() && child.exit_code == 2;
}

std::string failure_of(const ChildResult& child, const std::optional<RunRecord>& record,
                       const std::string& launch, const std::string& program) {
  if (record && record->exit_code != 0)
    return fmt::format("{} failed with exit code {}", program, record->exit_code);
  if (child.signal)
    return fmt::format(
        "{} was ended by a signal: {}{}{}", program, ::strsignal(child.signal), remedy_of(child.signal),
        child.signal == SIGKILL ? "; if nobody did it, memory was out: at most " + memory_limit() : "");
  if (child.exit_code == 0)
    return record ? "" : fmt::format("{} succeeded, but left no record of its run", program);
  if (launch.empty()) return fmt::format("{} failed with exit code {}", program, child.exit_code);
  if (!record && (child.exit_code == 126 || child.exit_code == 127))
    throw InputError(
        "LAUNCH='{}': {} (exit code {}): its first word must be a command on this machine's PATH, as in "
        "LAUNCH='srun -n1'; without LAUNCH stages run here",
        launch, child.exit_code == 127 ? "no such command" : "the command can't be run", child.exit_code);
  const int number = child.exit_code - 128;
  const std::string signal = number > 0 && number < NSIG ? fmt::format(", as of a signal: {}{}",
                                                                       ::strsignal(number), remedy_of(number))
                                                         : "";
  return fmt::format("{} {}: LAUNCH='{}' gave exit code {}{}", program,
                     record ? "succeeded, its launcher did not" : "did not come to its end", launch,
                     child.exit_code, signal);
}

void Tries::fail(const std::string& why, bool stopped) {
  const int done = failed() + 1;
  if (stopped || done > retries_)
    throw StageFailure(fmt::format("{}: {}{}", name_, why,
                                   done > 1 ? fmt::format(" (try {} of {})", done, retries_ + 1) : ""));
  failures_.push_back(why);
  fmt::print(stderr, "{}: {}; try {} of {}\n", name_, why, done + 1, retries_ + 1);
}

}  // namespace hbr::inline artifact
