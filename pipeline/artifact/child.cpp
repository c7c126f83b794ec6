#include "pipeline/artifact/child.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>

#include "pipeline/core/check.h"

namespace hbr {
namespace {

volatile std::sig_atomic_t child_to_signal = 0, stopped = 0;

void hand_on(int signal) {
  stopped = 1;
  if (child_to_signal > 0) ::kill(child_to_signal, signal);
}

}  // namespace

void end_with_parent(int parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);  // it ended before the line above
}

ChildResult run_child(const std::vector<std::string>& command) {
  if (stopped) return {-1, SIGTERM, true, 0};
  std::vector<char*> words;
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);

  // Signals wait until the child's number is known.
  sigset_t handed_on, before;
  sigemptyset(&handed_on);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&handed_on, signal);
  ::sigprocmask(SIG_BLOCK, &handed_on, &before);
  int told[2];  // the child's errno where the program can't be started; closes with exec
  if (::pipe2(told, O_CLOEXEC) != 0) throw InputError("can't start {}: {}", command[0], std::strerror(errno));
  const auto started = std::chrono::steady_clock::now();
  const pid_t parent = ::getpid(), child = ::fork();
  if (child == 0) {
    end_with_parent(parent);
    ::sigprocmask(SIG_SETMASK, &before, nullptr);
    std::signal(SIGXFSZ, SIG_DFL);
    ::execvp(words[0], words.data());
    const int reason = errno;
    if (::write(told[1], &reason, sizeof reason) < 0) ::_exit(126);
    ::_exit(127);
  }
  ::close(told[1]);
  if (child < 0) {
    ::close(told[0]);
    ::sigprocmask(SIG_SETMASK, &before, nullptr);
    throw InputError("can't start {}: {}", command[0], std::strerror(errno));
  }
  child_to_signal = child;
  struct sigaction action {};
  action.sa_handler = hand_on;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::sigaction(signal, &action, nullptr);
  ::sigprocmask(SIG_SETMASK, &before, nullptr);

  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  child_to_signal = 0;
  int reason = 0;
  const bool unstarted = ::read(told[0], &reason, sizeof reason) == sizeof reason;
  ::close(told[0]);
  if (unstarted) throw InputError("can't start {}: {}", command[0], std::strerror(reason));

  ChildResult result;
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  result.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  result.stopped = stopped;
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return result;
}

}  // namespace hbr
