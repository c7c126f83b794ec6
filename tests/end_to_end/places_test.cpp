// Output folders that are full or can only be read, users who may not write, machines without memory.
#include <gmock/gmock.h>

#include <algorithm>

#include "pipeline/core/sanitizers.h"
#include "tests/end_to_end/small_file_system.h"

namespace hbr {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kNoMount = "neither this user nor a namespace of theirs may mount a file system";

std::ptrdiff_t lines(const ShellResult& outcome) { return std::ranges::count(outcome.text, '\n'); }

TEST(Places, AFullDiskIsToldAndRecoveredFrom) {
  FakeFolder folder("tmpfs");
  fs::create_directories(folder.out());
  const SmallFileSystem small(folder.out(), "size=1M");
  if (!small.mounted) GTEST_SKIP() << kNoMount;
  folder.profile.layer_b.size = 80'000;  // 640 kB each
  const ShellResult full = shell(small.words + folder.command("make"));
  const auto artifacts = FakeFolder::artifacts(small.seen());
  const ShellResult audit = shell(small.words + folder.command("audit"));
  small.change("size=20M");
  const ShellResult again = shell(small.words + folder.command("make"));
  EXPECT_NE(full.code, 0);
  EXPECT_THAT(full.text, HasSubstr("No space left on device; make room"));
  EXPECT_THAT(artifacts, testing::Contains(testing::Key("base.h5")));
  EXPECT_THAT(artifacts, Not(testing::Contains(testing::Key(HasSubstr(".tmp")))));
  EXPECT_EQ(audit.code, 0) << audit.text;
  EXPECT_EQ(again.code, 0) << again.text;
}

TEST(Places, WithoutInodesTheFileAndARemedyAreTold) {
  FakeFolder folder("inodes");
  fs::create_directories(folder.out());
  const SmallFileSystem small(folder.out(), "size=4M,nr_inodes=16");
  if (!small.mounted) GTEST_SKIP() << kNoMount;
  folder.profile.replications = 20;
  const ShellResult full = shell(small.words + folder.command("make"));
  small.change("nr_inodes=10000");
  const ShellResult again = shell(small.words + folder.command("make"));
  EXPECT_NE(full.code, 0);
  EXPECT_THAT(full.text, HasSubstr(folder.out().string()));
  EXPECT_THAT(full.text, HasSubstr("No space left on device; no inodes are left there: remove files"));
  EXPECT_THAT(full.text, Not(HasSubstr("unexpected error")));
  EXPECT_EQ(again.code, 0) << again.text;
}

// A folder full of something else.
void put_folder(const fs::path& place) {
  fs::remove_all(place);
  fs::create_directories(place / "inner");
}

TEST(Places, OtherThingsInThePlaceOfArtifactsAndManifestsGiveWay) {
  FakeFolder folder("others");
  ASSERT_EQ(folder.make().code, 0);
  const auto artifacts = folder.artifacts();
  put_folder(folder.out() / "sum.json");
  put_folder(folder.out() / "base.h5");
  fs::remove(folder.out() / "layer_a/00.h5");
  fs::create_symlink("00.h5", folder.out() / "layer_a/00.h5");
  fs::remove_all(folder.out() / "pages");
  fs::create_symlink("layer_b", folder.out() / "pages");
  const ShellResult outcome = folder.make();
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_EQ(made(outcome), "base layer_a/00 pages sum");
  EXPECT_TRUE(folder.artifacts() == artifacts);
  EXPECT_EQ(shell(folder.command("audit")).code, 0);
}

// What is not the project's own is left alone, and named.
TEST(Places, OtherThingsInThePlaceOfItsOwnFoldersAreNamed) {
  FakeFolder folder("own");
  for (const char* place : {".plan", ".plan/lock", ".plan/claim", ".plan/hashes.json", "layer_a"}) {
    folder.make();
    fs::remove_all(folder.out() / place);
    if (fs::path(place).has_parent_path())
      fs::create_directory(folder.out() / place);
    else
      std::ofstream(folder.out() / place) << "somebody\'s";
    const ShellResult outcome = folder.make();
    EXPECT_EQ(outcome.code, 2) << outcome.text;
    EXPECT_THAT(outcome.text, HasSubstr((folder.out() / place).string() + ": "));
    EXPECT_THAT(outcome.text, HasSubstr("remove "));
    EXPECT_THAT(outcome.text, Not(HasSubstr("unexpected")));
    EXPECT_TRUE(fs::exists(folder.out() / place));
    fs::remove_all(folder.out() / place);
    EXPECT_EQ(folder.make().code, 0);
  }
}

// What may be asked of a finished run, and of one that is not.
void expect_readable(FakeFolder& folder, const std::string& words, const std::string& reason) {
  for (const char* subcommand : {"make", "status", "audit", "graph", "plan"}) {
    const ShellResult outcome = shell(words + folder.command(subcommand));
    EXPECT_EQ(outcome.code, 0) << subcommand << ": " << outcome.text;
  }
  EXPECT_THAT(shell(words + folder.command("make")).text, HasSubstr("nothing to do, 7 artifacts"));
  folder.profile.sum.number = 77;
  EXPECT_EQ(shell(words + folder.command("status")).code, 0);
  const ShellResult unfinished = shell(words + folder.command("make"));
  EXPECT_EQ(unfinished.code, 2) << unfinished.text;
  EXPECT_EQ(lines(unfinished), 1) << unfinished.text;
  EXPECT_THAT(unfinished.text,
              HasSubstr("2 of 7 artifacts are to be made (`make status` says why), and this output "
                        "folder can't be written: " +
                        reason));
}

TEST(Places, AFinishedRunMayStandWhereItCanOnlyBeRead) {
  FakeFolder folder("readonly");
  fs::create_directories(folder.out());
  const SmallFileSystem small(folder.out(), "size=4M");
  if (!small.mounted) GTEST_SKIP() << kNoMount;
  const ShellResult made = shell(small.words + folder.command("make"));
  ASSERT_EQ(made.code, 0) << made.text;
  small.change("ro");
  expect_readable(folder, small.words, "Read-only file system; ");
}

TEST(Places, AnotherUsersFinishedRunMayBeLookedAt) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can become another user";
  FakeFolder folder("nobody");
  // The programs beside it: who built them may keep all others out.
  for (const char* program : {"fake_tool", "fake_stage"})
    fs::copy_file(std::string(HBR_BINARY_DIR) + "/fake/" + program, folder.path / program);
  folder.programs = folder.path;
  ASSERT_EQ(folder.make().code, 0);
  const fs::path counts = folder.path / "counts";  // of the programs that `make coverage` instruments
  fs::create_directories(counts);
  fs::permissions(counts, fs::perms::all);
  expect_readable(
      folder, "setpriv --reuid=65534 --regid=65534 --clear-groups env GCOV_PREFIX=" + counts.string() + " ",
      "Permission denied; ");
}

TEST(Places, WithoutMemoryTheStageAndTheLimitAreTold) {
#if HBR_ADDRESS_SANITIZER || HBR_THREAD_SANITIZER
  GTEST_SKIP() << "the sanitizers need all addresses there are";
#endif
  FakeFolder folder("memory");
  folder.profile.layer_a.size = 100'000'000;
  const ShellResult outcome = shell("ulimit -v 500000; " + folder.command("make"));
  EXPECT_NE(outcome.code, 0);
  EXPECT_THAT(outcome.text,
              HasSubstr("layer_a/00: out of memory: at most 0.5 GB (ulimit -v); raise the limit, or use "
                        "fewer THREADS or jobs (-j)"));
  EXPECT_EQ(folder.artifacts().size(), 1u);  // base
  // The kernel, too, ends who takes more than there is.
  const fs::path killer = folder.path / "killer";
  std::ofstream(killer) << "#!/bin/sh\nkill -9 $$\n";
  fs::permissions(killer, fs::perms::owner_all);
  EXPECT_THAT(folder.make("--launch " + killer.string()).text,
              HasSubstr("Killed; if nobody did it, memory was out: at most "));
  folder.profile.layer_a.size = 1;
  EXPECT_EQ(folder.make().code, 0);
}

}  // namespace
}  // namespace hbr
