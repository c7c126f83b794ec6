// File systems that no test has at hand: full ones that say so late, and those without locks. In this program
// the C library's functions are called by way of these.
#include <gmock/gmock.h>
#include <sys/file.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "pipeline/artifact/claim.h"
#include "pipeline/artifact/content.h"
#include "pipeline/artifact/lock.h"
#include "pipeline/artifact/stage.h"
#include "pipeline/core/check.h"
#include "pipeline/process/child.h"
#include "tests/support/temporary_folder.h"

namespace {

// The errno that each fails with, where it is to fail.
int close_error = 0, fsync_error = 0, flock_error = 0;

int or_failure(long result, int error) {
  if (error == 0) return static_cast<int>(result);
  errno = error;
  return -1;
}

}  // namespace

extern "C" int close(int file) { return or_failure(::syscall(SYS_close, file), close_error); }
extern "C" int fsync(int file) { return or_failure(::syscall(SYS_fsync, file), fsync_error); }
extern "C" int flock(int file, int operation) noexcept {
  return or_failure(flock_error == 0 ? ::syscall(SYS_flock, file, operation) : -1, flock_error);
}

namespace hbr {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(OddFileSystems, ThatAreFullMaySaySoWhenAFileIsClosed) {
  const TemporaryFolder folder;
  const auto told =
      ThrowsMessage<InputError>(HasSubstr("file: can't write: Disk quota exceeded; your quota"));
  close_error = EDQUOT;
  EXPECT_THAT([&] { write_whole(folder.path() / "file", "text"); }, told);
  EXPECT_TRUE(fs::is_empty(folder.path()));
  EXPECT_THAT([&] { write_file(folder.path() / "file", "text"); }, told);
  close_error = 0;
}

// What a stage has written is on the disk when it has succeeded: it is told by the host that wrote it.
TEST(OddFileSystems, ThatAreFullMakeTheStageFail) {
  const TemporaryFolder folder;
  const std::string root = folder.path().string();
  std::ofstream(folder.path() / "slice.json")
      << R"({"stage": "s", "name": "s", "settings": {}, "inputs": {}, "output": "s"})";
  std::vector<std::string> words{
      "s",        "--root",    root,           "--slice",      root + "/slice.json",
      "--output", root + "/s", "--checkpoint", root + "/check"};
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  for (const char* inside : {"", "deep/file"}) {
    testing::internal::CaptureStderr();
    fsync_error = EDQUOT;
    const int code = stage_main(static_cast<int>(words.size()), argv.data(), "A stage", [&](StageRun& stage) {
      if (*inside) fs::create_directories((stage.output() / inside).parent_path());
      write_file(*inside ? stage.output() / inside : stage.output(), "result");
    });
    fsync_error = 0;
    EXPECT_EQ(code, 2);
    EXPECT_THAT(testing::internal::GetCapturedStderr(),
                HasSubstr("can't write through to the disk: Disk quota exceeded; your quota"));
    fs::remove_all(folder.path() / "s");
  }
}

// Each says it in its own words: NFS, FUSE, Lustre.
TEST(OddFileSystems, WithoutLocksHaveTheClaim) {
  for (const int error : {ENOLCK, EOPNOTSUPP, ENOSYS}) {
    const TemporaryFolder folder;
    flock_error = error;
    const Ending ending = wait_for(start_work([&] {
      lock_folder(folder.path());
      return claim_of(folder.path()) == text_of(this_process()) ? 0 : 1;
    }));
    flock_error = 0;
    EXPECT_EQ(ending.exit_code, 0) << std::strerror(error);
    // The claim's keeper takes it away, soon.
    for (int patience = 0; patience < 500 && !claim_of(folder.path()).empty(); ++patience)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_EQ(claim_of(folder.path()), "");
  }
}

}  // namespace
}  // namespace hbr
