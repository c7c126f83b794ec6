#include "pipeline/artifact/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace hbr::inline artifact {
namespace {

using std::chrono::duration;
constexpr duration<double> kChangeEvery{0.2};
constexpr duration<double> kLineEvery{10};

bool shares_terminal() {
  const char* mode = std::getenv("HBR_PROGRESS");
  return mode && std::string_view(mode) == "lines";
}

}  // namespace

double seconds_now() { return duration<double>(std::chrono::system_clock::now().time_since_epoch()).count(); }

std::string duration_text(double seconds) {
  if (!std::isfinite(seconds)) return "unknown time";
  const auto whole = static_cast<std::int64_t>(std::llround(seconds));
  if (seconds < 9.95) return fmt::format("{:.1f} s", seconds);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string progress_text(const std::string& name, std::int64_t done, std::int64_t total, const char* unit,
                          double rate) {
  const double share = total > 0 ? static_cast<double>(done) / static_cast<double>(total) : 1;
  std::string text =
      fmt::format("{}: {} of {} {}, {:.0f} %", name, done, total, unit, std::floor(100 * share));
  if (rate > 0)
    text += fmt::format(", {:.{}f}/s, {} left", rate, rate < 10 ? 2 : 0,
                        duration_text(static_cast<double>(total - done) / rate));
  return text;
}

Progress::Progress(std::string name)
    : name_(std::move(name)), changing_(isatty(STDERR_FILENO) && !shares_terminal()) {}

Progress::~Progress() {
  if (open_) std::fputs("\r\033[K", stderr);
}

void Progress::show(std::int64_t done, std::int64_t total, const char* unit) {
  const Clock::time_point now = Clock::now();
  if (first_done_ < 0) {
    first_done_ = done;
    started_ = shown_ = now;
    return;
  }
  if (now - shown_ < (changing_ ? kChangeEvery : kLineEvery)) return;
  shown_ = now;
  const double rate = static_cast<double>(done - first_done_) / duration<double>(now - started_).count();
  const std::string text = progress_text(name_, done, total, unit, rate);
  // One write each, so that lines of stages that run side by side do not mix.
  const std::string line = changing_ ? "\r" + text + "\033[K" : text + "\n";
  std::fputs(line.c_str(), stderr);
  std::fflush(stderr);
  open_ = changing_;
}

}  // namespace hbr::inline artifact
