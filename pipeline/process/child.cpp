#include "pipeline/process/child.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>
#include <utility>

#include "pipeline/core/check.h"

namespace hbr::inline process {
namespace {

std::vector<char*> pointers(const std::vector<std::string>& texts) {
  std::vector<char*> result;
  for (const std::string& text : texts) result.push_back(const_cast<char*>(text.c_str()));
  result.push_back(nullptr);
  return result;
}

[[noreturn]] void not_started(const std::string& what, int reason) {
  if (reason == EAGAIN || reason == ENOMEM || reason == EMFILE || reason == ENFILE)
    throw std::system_error(reason, std::generic_category(), "can't start " + what);
  throw InputError("can't start {}: {}{}", what, std::strerror(reason),
                   reason == ENOENT ? "; is it installed?" : "");
}

}  // namespace

int start_work(const std::function<int()>& work) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit([&]() noexcept { return work(); }());
  if (child < 0) not_started("a process", errno);
  return child;
}

int start_program(const Program& program, const StandardFiles& files) {
  HBR_CHECK(!program.words.empty(), "no program to run");
  const std::vector<char*> words = pointers(program.words), variables = pointers(program.environment);
  int told[2];  // the child's errno where the program can't be started; closes with exec
  if (::pipe2(told, O_CLOEXEC) != 0) not_started(program.words[0], errno);
  const pid_t parent = ::getpid();
  int child = 0;
  try {
    child = start_work([&] {
      end_with_parent(parent);
      for (const auto& [file, as] :
           {std::pair(files.input, STDIN_FILENO), std::pair(files.output, STDOUT_FILENO),
            std::pair(files.errors, STDERR_FILENO)})
        if (file >= 0 && ::dup2(file, as) == file) ::fcntl(as, F_SETFD, 0);  // it is in place, and stays
      std::signal(SIGXFSZ, SIG_DFL);
      sigset_t none;
      sigemptyset(&none);
      ::sigprocmask(SIG_SETMASK, &none, nullptr);
      ::execvpe(words[0], words.data(), program.environment.empty() ? environ : variables.data());
      const int reason = errno;
      return ::write(told[1], &reason, sizeof reason) < 0 ? 126 : 127;
    });
  } catch (...) {
    ::close(told[0]);
    ::close(told[1]);
    throw;
  }
  ::close(told[1]);
  int reason = 0;
  ssize_t got = 0;
  while ((got = ::read(told[0], &reason, sizeof reason)) < 0 && errno == EINTR) continue;
  ::close(told[0]);
  if (got != sizeof reason) return child;
  wait_for(child);
  not_started(program.words[0], reason);
}

Ending wait_for(int child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) throw InputError("lost sight of process {}: {}", child, std::strerror(errno));
  if (WIFSIGNALED(status)) return {-1, WTERMSIG(status)};
  return {WEXITSTATUS(status), 0};
}

void become(const std::vector<std::string>& words) {
  ::execvp(words.at(0).c_str(), pointers(words).data());
  not_started(words[0], errno);
}

void signal_at_end_of_parent(int signal) { ::prctl(PR_SET_PDEATHSIG, signal); }

void end_with_parent(int parent) {
  signal_at_end_of_parent(SIGKILL);
  if (::getppid() != parent) ::_exit(1);  // it ended before the line above
}

}  // namespace hbr::inline process
