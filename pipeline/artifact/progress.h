// How far a long run is, told on stderr: on a terminal of its own one line that changes, else a line now and
// then.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace hbr::inline artifact {

class Progress {
 public:
  // `name` leads every line. With the environment's HBR_PROGRESS=lines (several stages share the terminal) a
  // terminal gets lines, too.
  explicit Progress(std::string name);
  ~Progress();
  Progress(const Progress&) = delete;

  // Cheap enough to call for every generation. The rate counts from the first call, so that a run that goes
  // on from a checkpoint tells its true time left.
  void show(std::int64_t done, std::int64_t total, const char* unit);

 private:
  using Clock = std::chrono::steady_clock;

  std::string name_;
  bool changing_;  // one line that changes
  bool open_ = false;
  std::int64_t first_done_ = -1;
  Clock::time_point started_, shown_;
};

// Seconds after 1970.
double seconds_now();
// "4.2 s", "42 s", "3:07" (minutes), "2:03:07" (hours).
std::string duration_text(double seconds);
// "layer1/03: 4200 of 10000 generations, 42 %, 103/s, 0:56 left"
std::string progress_text(const std::string& name, std::int64_t done, std::int64_t total, const char* unit,
                          double rate);

}  // namespace hbr::inline artifact
