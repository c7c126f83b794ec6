// What a run of a stage program cost and where it ran, as the program itself measured it: whoever launched it
// knows only the launcher (an srun waits elsewhere, and needs next to nothing). Handed to the runner in a
// small file.
#pragma once

#include <chrono>
#include <cstdint>
#include <ctime>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "pipeline/core/settings.h"

namespace hbr::inline artifact {

struct RunRecord {
  int exit_code = 0;
  std::string started;  // UTC
  std::string host;
  int threads = 1;
  double seconds = 0, cpu_seconds = 0;  // the latter of all threads and of the program's own children
  std::int64_t peak_memory_bytes = 0;   // of the program or the largest of its children
  nlohmann::json toolchain;             // toolchain.h
};

template <class Fields>
void describe(Fields& f, RunRecord& r) {
  f.number("exit", r.exit_code, Range{0, 255}, "exit code");
  f.text("started", r.started, "when the program started, UTC");
  f.text("host", r.host, "where it ran");
  f.number("threads", r.threads, Range{1, 4096}, "threads that it used");
  f.number("seconds", r.seconds, Range{0, 1e9}, "from its start to its end");
  f.number("cpu_seconds", r.cpu_seconds, Range{0, 1e12}, "processor time");
  f.number("peak_memory_bytes", r.peak_memory_bytes, Range{0, 1e18}, "most memory");
  f.raw_table("toolchain", r.toolchain, "compiler, flags, processor and libraries");
}

// Measures from its making on; one for each process, at its start.
class RunMeter {
 public:
  RunRecord read(int exit_code, int threads) const;

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::time_t started_ = std::time(nullptr);
};

void write_record(const std::filesystem::path& path, const RunRecord& record);
// Nothing where there is none; throws InputError where it is not as write_record left it.
std::optional<RunRecord> read_record(const std::filesystem::path& path);

}  // namespace hbr::inline artifact
