// What a program measures of itself.
#include "pipeline/artifact/record.h"

#include <gmock/gmock.h>
#include <sys/resource.h>

#include <fstream>
#include <vector>

#include "pipeline/core/check.h"
#include "pipeline/process/child.h"
#include "pipeline/process/identity.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

using testing::HasSubstr;

// Until the process has used that much more processor time.
void compute(double seconds) {
  const auto used = [] {
    rusage all{};
    ::getrusage(RUSAGE_SELF, &all);
    return static_cast<double>(all.ru_utime.tv_sec + all.ru_stime.tv_sec) +
           1e-6 * static_cast<double>(all.ru_utime.tv_usec + all.ru_stime.tv_usec);
  };
  for (const double until = used() + seconds; used() < until;) continue;
}

template <class Task>
void in_a_child(Task task) {
  wait_for(start_work([&] {
    task();
    return 0;
  }));
}

TEST(RunRecord, CountsTheProgramAndItsChildren) {
  const RunMeter meter;
  compute(0.1);
  const RunRecord own = meter.read(3, 2);
  EXPECT_GE(own.cpu_seconds, 0.1);
  EXPECT_GE(own.seconds, 0.1);
  EXPECT_EQ(own.exit_code, 3);
  EXPECT_EQ(own.threads, 2);
  EXPECT_EQ(own.host, this_host());
  EXPECT_TRUE(own.toolchain.contains("processor"));
  // More than this process, which may have run other tests before, and their children have ever had.
  const auto bytes = static_cast<std::size_t>(own.peak_memory_bytes) + 50'000'000;
  in_a_child([bytes] {
    compute(0.2);
    const std::vector<char> large(bytes, 'x');
    compute(large[bytes / 2] == 'x' ? 0 : 1);
  });
  const RunRecord both = meter.read(0, 2);
  EXPECT_GE(both.cpu_seconds, own.cpu_seconds + 0.2);
  EXPECT_GE(both.peak_memory_bytes, static_cast<std::int64_t>(bytes));
}

TEST(RunRecord, IsReadAsItWasWrittenAndNothingElseIs) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "record";
  EXPECT_FALSE(read_record(file));
  const RunRecord record = RunMeter().read(0, 4);
  write_record(file, record);
  EXPECT_EQ(settings_to_json(*read_record(file)), settings_to_json(record));
  nlohmann::json all = settings_to_json(record);
  const auto message = [&](const std::string& text) -> std::string {
    std::ofstream(file) << text;
    try {
      read_record(file);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_THAT(message(""), HasSubstr("record: not JSON: "));
  EXPECT_THAT(message(all.dump().substr(0, 40)), HasSubstr("record: not JSON: "));
  all["cpu_seconds"] = "many";
  EXPECT_THAT(message(all.dump()), HasSubstr("cpu_seconds"));
  all.erase("cpu_seconds");
  EXPECT_THAT(message(all.dump()), HasSubstr("cpu_seconds"));
}

}  // namespace
}  // namespace hbr
