#include "pipeline/process/run_child.h"

#include <chrono>
#include <csignal>

namespace hbr::inline process {
namespace {

volatile std::sig_atomic_t child_to_signal = 0, stopped = 0;

void hand_on(int signal) {
  stopped = 1;
  if (child_to_signal > 0) ::kill(child_to_signal, signal);
}

// Signals wait as long as it lives: until the child's number is known.
class SignalsWait {
 public:
  SignalsWait() {
    sigset_t handed_on;
    sigemptyset(&handed_on);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&handed_on, signal);
    ::sigprocmask(SIG_BLOCK, &handed_on, &before_);
  }
  ~SignalsWait() { ::sigprocmask(SIG_SETMASK, &before_, nullptr); }
  SignalsWait(const SignalsWait&) = delete;

 private:
  sigset_t before_;
};

}  // namespace

ChildResult run_child(const std::vector<std::string>& command) {
  if (stopped) return {{-1, SIGTERM}, true, 0};
  const auto started = std::chrono::steady_clock::now();
  {
    const SignalsWait wait;
    child_to_signal = start_program({command});
    struct sigaction action {};
    action.sa_handler = hand_on;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
      struct sigaction before {};
      ::sigaction(signal, nullptr, &before);
      if (before.sa_handler != SIG_IGN) ::sigaction(signal, &action, nullptr);
    }
  }
  const Ending ending = wait_for(child_to_signal);
  child_to_signal = 0;
  return {ending, stopped != 0,
          std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count()};
}

}  // namespace hbr::inline process
