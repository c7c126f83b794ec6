#include "pipeline/core/memory_limit.h"

#include <gmock/gmock.h>
#include <sys/resource.h>

#include <fstream>

#include "pipeline/core/sanitizers.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

namespace fs = std::filesystem;
using testing::EndsWith;

class MemoryLimit : public testing::Test {
 protected:
  void write(const fs::path& file, const std::string& text) const {
    fs::create_directories((folder_.path() / file).parent_path());
    std::ofstream(folder_.path() / file) << text;
  }
  std::string limit() const { return memory_limit(folder_.path()); }
  const TemporaryFolder folder_;
};

TEST_F(MemoryLimit, IsTheMachinesWhereNothingIsSet) {
  const std::string machine = limit();
  EXPECT_THAT(machine, EndsWith(" GB (the machine's memory)"));
  write("proc/self/cgroup", "0::/user.slice\n");
  write("sys/fs/cgroup/user.slice/memory.max", "max\n");
  EXPECT_EQ(limit(), machine);
  write("sys/fs/cgroup/user.slice/memory.max", "1000000000000000\n");  // more than there is
  EXPECT_EQ(limit(), machine);
}

TEST_F(MemoryLimit, OfTheGroupOrOfOneAboveIt) {
  write("proc/self/cgroup", "0::/user.slice/session\n");
  write("sys/fs/cgroup/user.slice/session/memory.max", "200000000\n");
  EXPECT_EQ(limit(), "0.2 GB (its control group)");
  write("sys/fs/cgroup/user.slice/memory.max", "100000000\n");
  EXPECT_EQ(limit(), "0.1 GB (its control group)");
  write("sys/fs/cgroup/memory.max", "300000000\n");
  EXPECT_EQ(limit(), "0.1 GB (its control group)");
}

TEST_F(MemoryLimit, OfTheFirstVersionsGroupOfMemoryOnly) {
  write("proc/self/cgroup", "12:cpu,cpuacct:/a\n9:memory:/b\n");
  for (const char* place : {"sys/fs/cgroup/a/memory.max", "sys/fs/cgroup/b/memory.max",
                            "sys/fs/cgroup/memory/a/memory.limit_in_bytes"})
    write(place, "100000000\n");
  write("sys/fs/cgroup/memory/b/memory.limit_in_bytes", "400000000\n");
  EXPECT_EQ(limit(), "0.4 GB (its control group)");
}

TEST_F(MemoryLimit, OfTheShellWhereThatIsLess) {
#if HBR_ADDRESS_SANITIZER || HBR_THREAD_SANITIZER
  GTEST_SKIP() << "the sanitizers need all addresses there are";
#endif
  write("proc/self/cgroup", "0::/\n");
  write("sys/fs/cgroup/memory.max", "200000000\n");
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_DATA, &before), 0);
  rlimit small = before;
  small.rlim_cur = 100'000'000;
  ::setrlimit(RLIMIT_DATA, &small);
  const std::string told = limit();
  ::setrlimit(RLIMIT_DATA, &before);
  EXPECT_EQ(told, "0.1 GB (ulimit -d)");
}

}  // namespace
}  // namespace hbr
