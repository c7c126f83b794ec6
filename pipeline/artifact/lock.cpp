#include "pipeline/artifact/lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <optional>
#include <thread>

#include "pipeline/artifact/claim.h"
#include "pipeline/core/file_error.h"
#include "pipeline/process/child.h"

namespace hbr::inline artifact {
namespace {

constexpr const char* kVariable = "HBR_LOCK";  // the descriptor's number, for children
using namespace std::chrono_literals;
// What was killed a moment ago may take a while to be gone; the keeper of a claim whose holder has ended, on
// a busy machine, a long one.
constexpr auto kPatience = 1500ms, kPatienceWithKeeper = 30'000ms;

}  // namespace

void lock_folder(const std::filesystem::path& out) {
  std::error_code error;
  std::filesystem::create_directories(out / ".plan", error);
  if (error)
    throw file_error(std::filesystem::is_directory(out) ? out / ".plan" : out,
                     "can't make this output folder", error.value());
  const std::filesystem::path file = out / ".plan/lock";
  const int lock = ::open(file.c_str(), O_RDWR | O_CREAT, 0666);
  if (lock < 0) throw file_error(file, "can't write to this output folder", errno);
  const auto begin = std::chrono::steady_clock::now();
  while (::flock(lock, LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK && errno != EINTR) break;  // there are no locks here: the claim has to do
    const std::optional<Process> holder = process_of(claim_of(out));
    const bool ended = holder && holder->host == this_host() && !is_alive(*holder);
    if (std::chrono::steady_clock::now() - begin > (ended ? kPatienceWithKeeper : kPatience))
      throw InputError(
          "{}: another make{} is at work in this folder: wait for it, stop it, or give another OUT",
          out.string(), holder ? fmt::format(" (process {} on {})", holder->id, holder->host) : "");
    std::this_thread::sleep_for(20ms);
  }
  ::setenv(kVariable, std::to_string(lock).c_str(), 1);

  const Process holder = this_process();
  claim_folder(out, holder);
  start_work([&]() -> int { keep_claim(out, holder); });
}

void leave_lock_to_parent() {
  if (const char* lock = std::getenv(kVariable)) ::close(std::atoi(lock));
  ::unsetenv(kVariable);
}

}  // namespace hbr::inline artifact
