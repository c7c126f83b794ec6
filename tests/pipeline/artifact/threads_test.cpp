// How many processors a process may use, by files made up for it.
#include "pipeline/artifact/threads.h"

#include <gtest/gtest.h>
#include <sched.h>

#include <cstdlib>
#include <fstream>

#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

namespace fs = std::filesystem;

class Threads : public testing::Test {
 protected:
  Threads() {
    for (const char* name : {"SLURM_CPUS_PER_TASK", "SLURM_CPUS_ON_NODE", "MAKEFLAGS", "HBR_PLACE"})
      ::unsetenv(name);
    ::sched_getaffinity(0, sizeof before_, &before_);
  }
  ~Threads() override { ::sched_setaffinity(0, sizeof before_, &before_); }
  void write(const std::string& file, const std::string& text) const {
    fs::create_directories((root_.path() / file).parent_path());
    std::ofstream(root_.path() / file) << text << "\n";
  }
  int found() const { return processors(root_.path()); }
  int all() const { return CPU_COUNT(&before_); }

  TemporaryFolder root_;
  cpu_set_t before_;
};

TEST_F(Threads, AffinityCounts) {
  EXPECT_EQ(found(), all());
  int first = 0;
  while (!CPU_ISSET(first, &before_)) ++first;
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(first, &one);
  ASSERT_EQ(::sched_setaffinity(0, sizeof one, &one), 0);
  EXPECT_EQ(found(), 1);
  EXPECT_EQ(threads_of_stage(0), 1);
  EXPECT_EQ(threads_of_stage(7), 7);
}

TEST_F(Threads, QuotasOfEitherVersionCount) {
  if (all() < 2) GTEST_SKIP() << "one processor has nothing to take away";
  write("proc/self/cgroup", "0::/user/job");
  write("sys/fs/cgroup/user/job/cpu.max", "max 100000");
  EXPECT_EQ(found(), all());
  write("sys/fs/cgroup/user/job/cpu.max", "190000 100000");
  EXPECT_EQ(found(), 1);  // 1.9
  write("sys/fs/cgroup/user/job/cpu.max", "20000 100000");
  EXPECT_EQ(found(), 1);
  write("sys/fs/cgroup/user/job/cpu.max", "max 100000");
  write("sys/fs/cgroup/user/cpu.max", "100000 100000");  // a group above
  EXPECT_EQ(found(), 1);

  write("proc/self/cgroup", "11:memory:/a\n5:cpu,cpuacct:/docker/b");
  EXPECT_EQ(found(), all());
  write("sys/fs/cgroup/cpu,cpuacct/docker/b/cpu.cfs_quota_us", "-1");
  write("sys/fs/cgroup/cpu,cpuacct/docker/b/cpu.cfs_period_us", "50000");
  EXPECT_EQ(found(), all());
  write("sys/fs/cgroup/cpu,cpuacct/docker/b/cpu.cfs_quota_us", "50000");
  EXPECT_EQ(found(), 1);
  write("proc/self/cgroup", "11:cpuset:/docker/b");
  EXPECT_EQ(found(), all());
}

TEST_F(Threads, WhatSlurmGaveCounts) {
  if (all() < 2) GTEST_SKIP() << "one processor has nothing to take away";
  ::setenv("SLURM_CPUS_ON_NODE", "1", 1);
  EXPECT_EQ(found(), 1);
  ::setenv("SLURM_CPUS_PER_TASK", "2", 1);  // says more of the task
  EXPECT_EQ(found(), 2);
  ::setenv("SLURM_CPUS_PER_TASK", "1", 1);
  EXPECT_EQ(found(), 1);
}

TEST_F(Threads, AreSharedAmongTheJobsOfAMakeThatIsHere) {
  const auto with = [](const char* flags) {
    ::setenv("MAKEFLAGS", flags, 1);
    return threads_of_stage(0);
  };
  EXPECT_EQ(with(""), processors());
  EXPECT_EQ(with(" -j1000 --jobserver-auth=3,4"), 1);
  EXPECT_EQ(with(" -j"), 1);
  EXPECT_EQ(with("k -- LAUNCH=x\\ -j1000"), processors());
  EXPECT_EQ(jobs_of_make(), 1);
  ::setenv("HBR_PLACE", this_place().c_str(), 1);
  EXPECT_EQ(with(" -j1000"), 1);
  ::setenv("HBR_PLACE", "another host  ", 1);
  EXPECT_EQ(with(" -j1000"), processors());
  ::setenv("HBR_PLACE", this_place().c_str(), 1);
  ::setenv("SLURM_STEP_ID", "7", 1);  // launched to here since
  EXPECT_EQ(with(" -j1000"), processors());
  ::unsetenv("SLURM_STEP_ID");
}

}  // namespace
}  // namespace hbr
