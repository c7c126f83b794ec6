#include "pipeline/artifact/record.h"

#include <fmt/chrono.h>
#include <sys/resource.h>

#include <algorithm>

#include "pipeline/artifact/content.h"
#include "pipeline/artifact/json_file.h"
#include "pipeline/artifact/toolchain.h"
#include "pipeline/core/check.h"
#include "pipeline/process/identity.h"

namespace hbr::inline artifact {
namespace {

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

RunRecord RunMeter::read(int exit_code, int threads) const {
  RunRecord record;
  record.exit_code = exit_code;
  record.started = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(started_));
  record.host = this_host();
  record.threads = threads;
  record.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  for (const int whose : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage used{};
    ::getrusage(whose, &used);
    record.cpu_seconds += seconds(used.ru_utime) + seconds(used.ru_stime);
    record.peak_memory_bytes = std::max<std::int64_t>(record.peak_memory_bytes, used.ru_maxrss * 1024);
  }
  record.toolchain = toolchain();
  return record;
}

void write_record(const std::filesystem::path& path, const RunRecord& record) {
  write_whole(path, settings_to_json(record).dump(1) + "\n");
}

std::optional<RunRecord> read_record(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) return {};
  return read_json_as<RunRecord>(path);
}

}  // namespace hbr::inline artifact
