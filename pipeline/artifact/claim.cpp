#include "pipeline/artifact/claim.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <optional>
#include <sstream>
#include <thread>

#include "pipeline/artifact/progress.h"
#include "pipeline/artifact/temporary.h"
#include "pipeline/core/file_error.h"
#include "pipeline/process/child.h"

namespace hbr::inline artifact {
namespace fs = std::filesystem;
namespace {

fs::path claim_path(const fs::path& out) { return out / ".plan/claim"; }

std::optional<Process> holder_of(const fs::path& out) { return process_of(claim_of(out)); }

[[noreturn]] void fail(const fs::path& out) {
  throw file_error(out, "can't write to this output folder", errno);
}

// Whether it is put there now. The first to get there makes the link; where there are no links, the first to
// look.
bool put(const fs::path& out, const fs::path& own) {
  if (::link(own.c_str(), claim_path(out).c_str()) == 0) return true;
  if (errno == EEXIST || fs::exists(claim_path(out))) return false;
  if (::rename(own.c_str(), claim_path(out).c_str()) != 0) fail(out);
  return true;
}

// By the clock that both files' times are of: the file system's.
std::chrono::seconds silence(const fs::path& claim, const fs::path& written_now) {
  struct stat theirs {
  }, ours{};
  if (::stat(claim.c_str(), &theirs) != 0 || ::stat(written_now.c_str(), &ours) != 0) return {};
  return std::chrono::seconds(std::max<std::time_t>(0, ours.st_mtim.tv_sec - theirs.st_mtim.tv_sec));
}

std::string text_of(std::chrono::seconds time) { return duration_text(static_cast<double>(time.count())); }

// The claim that stands in the way; throws where its holder lives.
void judge(const fs::path& out, const Process& own, std::chrono::seconds silent) {
  const std::optional<Process> other = holder_of(out);
  if (!other || *other == own) return;
  const bool here = other->host == own.host;
  if (here ? is_alive(*other) : silent < kSilence)
    throw InputError(
        "{}: another make (process {} on {}) is at work in this folder{}: wait for it, stop it, or give "
        "another OUT",
        out.string(), other->id, other->host,
        here ? ""
             : fmt::format(" (its last sign of life is {} old; after {} it counts as gone)", text_of(silent),
                           text_of(kSilence)));
  fmt::print(stderr, "{}: the make before (process {} on {}) was killed; this one takes its place\n",
             out.string(), other->id, other->host);
}

}  // namespace

std::string claim_of(const fs::path& out) {
  std::ostringstream text;
  text << std::ifstream(claim_path(out)).rdbuf();  // which fails, and does not throw, where it can't be read
  return text.str();
}

void claim_folder(const fs::path& out, const Process& holder) {
  const fs::path claim = claim_path(out);
  const fs::file_status there = fs::symlink_status(claim);
  if (fs::exists(there) && !fs::is_regular_file(there))
    throw file_error(claim, "can't claim this output folder", EEXIST);
  const Temporary own(temporary_beside(claim));
  std::ofstream(own.path) << text_of(holder) << std::flush;
  if (!fs::exists(own.path) || fs::file_size(own.path) == 0) fail(out);
  while (!put(out, own.path)) {
    if (!fs::exists(fs::symlink_status(claim))) continue;  // left this moment
    judge(out, holder, silence(claim, own.path));
    if (::rename(own.path.c_str(), claim.c_str()) != 0) fail(out);
    // Another host may do the same this moment: the later one holds it.
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    judge(out, holder, {});
    return;
  }
}

void keep_claim(const fs::path& out, const Process& holder) {
  sigset_t wakes;
  sigemptyset(&wakes);
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) sigaddset(&wakes, signal);
  ::sigprocmask(SIG_BLOCK, &wakes, nullptr);
  signal_at_end_of_parent(SIGTERM);
  while (::getppid() == holder.id) {
    const std::optional<Process> now = holder_of(out);
    if (now && !(*now == holder)) {
      fmt::print(stderr,
                 "{}: another make (process {} on {}) took this folder while nothing was heard of this one\n",
                 out.string(), now->id, now->host);
      ask_to_end(holder);
      ::_exit(1);
    }
    ::utimensat(AT_FDCWD, claim_path(out).c_str(), nullptr, 0);
    const timespec pause{kHeartbeat.count(), 0};
    ::sigtimedwait(&wakes, nullptr, &pause);
  }
  if (holder_of(out) == holder) ::unlink(claim_path(out).c_str());
  ::_exit(0);
}

}  // namespace hbr::inline artifact
