#include "pipeline/artifact/own_process.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>

#include "pipeline/artifact/child.h"
#include "pipeline/core/check.h"

namespace hbr {
namespace {

// The first byte of what the child says.
constexpr char kDone = 'd', kRefused = 'r';

void set_limit(int what, rlim_t most) {
  rlimit now{};
  ::getrlimit(what, &now);
  now.rlim_cur = now.rlim_max = std::min(now.rlim_max, most);
  ::setrlimit(what, &now);
}

rlim_t address_space_in_use() {
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
}

std::string said_by(const std::function<std::string()>& work) {
  try {
    return kDone + work();
  } catch (const std::bad_alloc&) {
    return kRefused + std::string("it asks for more memory than its size can explain");
  } catch (const std::exception& error) {
    return kRefused + std::string(error.what());
  }
}

void write_all(int file, const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t n = ::write(file, text.data() + at, text.size() - at);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) ::_exit(1);
    at += static_cast<std::size_t>(n);
  }
}

std::string read_all(int file) {
  std::string text;
  char buffer[1 << 16];
  for (;;) {
    const ssize_t n = ::read(file, buffer, sizeof buffer);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return text;
    text.append(buffer, static_cast<std::size_t>(n));
  }
}

}  // namespace

std::string OwnProcess::run(const std::string& what, const std::function<std::string()>& work) const {
  int ends[2];
  if (::pipe(ends) != 0) throw InputError("{}: can't be read: {}", what, std::strerror(errno));
  const pid_t parent = ::getpid(), child = ::fork();
  if (child == 0) {
    end_with_parent(parent);
    ::close(ends[0]);
    set_limit(RLIMIT_CORE, 0);
    set_limit(RLIMIT_CPU, cpu_seconds);
    set_limit(RLIMIT_AS, address_space_in_use() + memory_bytes);
    write_all(ends[1], said_by(work));
    ::_exit(0);
  }
  ::close(ends[1]);
  if (child < 0) {
    ::close(ends[0]);
    throw InputError("{}: can't be read: {}", what, std::strerror(errno));
  }
  const std::string said = read_all(ends[0]);
  ::close(ends[0]);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (status == 0 && !said.empty()) {
    if (said[0] == kDone) return said.substr(1);
    const std::string why = said.substr(1, said.find('\n') - 1);
    throw InputError("{}: {}", what, why);
  }
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  if (signal == SIGXCPU || signal == SIGKILL)
    throw InputError("{}: reading it does not end within {} s of computing", what, cpu_seconds);
  throw InputError("{}: the reader crashed on it{}; the file is damaged", what,
                   signal ? fmt::format(" ({})", ::strsignal(signal)) : "");
}

}  // namespace hbr
