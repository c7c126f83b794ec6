#include "pipeline/process/own_process.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <new>
#include <system_error>

#include "pipeline/core/check.h"
#include "pipeline/process/bytes.h"
#include "pipeline/process/child.h"

namespace hbr::inline process {
namespace {

// The first byte of what the child says.
constexpr char kDone = 'd', kRefused = 'r';

void set_limit(int what, rlim_t most) {
  rlimit now{};
  ::getrlimit(what, &now);
  now.rlim_cur = now.rlim_max = std::min(now.rlim_max, most);
  ::setrlimit(what, &now);
}

// At the soft limit comes SIGXCPU; the hard one stays, so that SIGKILL means something else.
void limit_computing(rlim_t seconds) {
  rlimit now{};
  ::getrlimit(RLIMIT_CPU, &now);
  now.rlim_cur = std::min(now.rlim_max, seconds);
  ::setrlimit(RLIMIT_CPU, &now);
  std::signal(SIGXCPU, SIG_DFL);
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

}  // namespace

std::string OwnProcess::run(const std::string& what, const std::function<std::string()>& work) const {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0)
    throw std::system_error(errno, std::generic_category(), what + ": can't be read");
  const int parent = ::getpid();
  int child = 0;
  try {
    child = start_work([&] {
      end_with_parent(parent);
      ::close(ends[0]);
      set_limit(RLIMIT_CORE, 0);
      limit_computing(cpu_seconds);
      set_limit(RLIMIT_AS, address_space_in_use() + memory_bytes);
      return write_all(ends[1], said_by(work)) ? 0 : 1;
    });
  } catch (...) {
    for (const int end : ends) ::close(end);
    throw;
  }
  ::close(ends[1]);
  const std::string said = read_all(ends[0]);
  ::close(ends[0]);
  const Ending ending = wait_for(child);
  if (ending.exit_code == 0 && !said.empty()) {
    if (said[0] == kDone) return said.substr(1);
    const std::string why = said.substr(1, said.find('\n') - 1);
    throw InputError("{}: {}", what, why);
  }
  if (ending.signal == SIGKILL) throw std::bad_alloc();  // by the kernel, whose memory is out
  if (ending.signal == SIGXCPU)
    throw InputError("{}: reading it does not end within {} s of computing", what, cpu_seconds);
  throw InputError("{}: the reader crashed on it{}; the file is damaged", what,
                   ending.signal ? fmt::format(" ({})", ::strsignal(ending.signal)) : "");
}

}  // namespace hbr::inline process
