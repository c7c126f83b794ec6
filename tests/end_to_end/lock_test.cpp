// Two makes on one folder, on one host and on two.
#include <gmock/gmock.h>

#include <chrono>

#include "pipeline/process/identity.h"
#include "tests/end_to_end/fake_folder.h"

namespace hbr {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class Claim : public testing::Test {
 protected:
  Claim() : folder("claim") {}
  fs::path claim() const { return folder.out() / ".plan/claim"; }
  std::string here() const { return this_host(); }
  void write(const std::string& holder, std::chrono::seconds age) const {
    fs::create_directories(claim().parent_path());
    std::ofstream(claim()) << holder;
    fs::last_write_time(claim(), fs::file_time_type::clock::now() - age);
  }
  // Shell lines before `meanwhile`, which runs while a make (of the shell's $make) is at work, and after.
  ShellResult while_at_work(const std::string& meanwhile) {
    folder.profile.base.steps = 2000;
    const std::string until = "until [ -e " + claim().string() + " ]; do sleep 0.01; done; ";
    return shell(folder.command("make", "base") + " & make=$!; " + until + meanwhile +
                 "; kill $make; wait $make 2>/dev/null; for i in {1..100}; do [ -e " + claim().string() +
                 " ] || break; sleep 0.02; done; echo claim left: $(cat " + claim().string() +
                 " 2>/dev/null)");
  }
  FakeFolder folder;
};

TEST_F(Claim, AnotherHostsHoldsWhileItGivesSignsOfLife) {
  write("77.1234@node7", std::chrono::seconds(200));
  const ShellResult held = folder.make();
  EXPECT_EQ(held.code, 2);
  EXPECT_THAT(held.text,
              HasSubstr("another make (process 77 on node7) is at work in this folder (its last sign of "
                        "life is 3:20 old; after 5:00 it counts as gone)"));
  EXPECT_TRUE(fs::exists(claim()));
  EXPECT_EQ(folder.artifacts().size(), 0u);

  write("77.1234@node7", std::chrono::seconds(400));
  const ShellResult free = folder.make();
  EXPECT_EQ(free.code, 0) << free.text;
  EXPECT_THAT(free.text,
              HasSubstr("the make before (process 77 on node7) was killed; this one takes its place"));
  EXPECT_EQ(folder.make().code, 0);  // and leaves none
}

TEST_F(Claim, OnItsOwnHostTheProcessIsLookedAt) {
  Process self = this_process();
  write(text_of(self), std::chrono::hours(2));
  EXPECT_THAT(folder.make().text,
              HasSubstr(fmt::format("another make (process {} on {})", self.id, self.host)));
  ++self.started;  // another that had its number
  write(text_of(self), std::chrono::seconds(0));
  const ShellResult free = folder.make();
  EXPECT_EQ(free.code, 0) << free.text;
  EXPECT_THAT(free.text, HasSubstr("takes its place"));
  write("what is this", std::chrono::seconds(0));
  EXPECT_EQ(folder.make().code, 0);
}

TEST_F(Claim, AHolderThatHasEndedIsWaitedForUntilItsLockIsFree) {
  Process ended = this_process();
  ++ended.started;
  write(text_of(ended), std::chrono::seconds(0));
  const ShellResult waited = shell("flock " + (folder.out() / ".plan/lock").string() +
                                   " sleep 3 & sleep 0.3; " + folder.command("make", "base"));
  EXPECT_EQ(waited.code, 0) << waited.text;
  EXPECT_EQ(made(waited), "base");
}

// Where a lock does not hold, as if each host had a file of its own.
TEST_F(Claim, HoldsWithoutALock) {
  const std::string unlock = "rm " + (folder.out() / ".plan/lock").string() + "; ";
  const ShellResult here = while_at_work(unlock + folder.command("make", "base") + "; echo code $?");
  EXPECT_THAT(here.text, HasSubstr("another make (process "));
  EXPECT_THAT(here.text, HasSubstr("code 2"));
  EXPECT_THAT(here.text, HasSubstr("claim left:\n"));
  if (shell("unshare --uts hostname node8").code != 0) GTEST_SKIP() << "only root may be another host";
  std::ofstream(folder.path / "elsewhere") << "hostname node8\n" << folder.command("make", "base") << "\n";
  const ShellResult there =
      while_at_work(unlock + "unshare --uts bash " + (folder.path / "elsewhere").string() + "; echo code $?");
  EXPECT_THAT(there.text, HasSubstr(" on " + this_host() + ") is at work in this folder (its last sign"));
  EXPECT_THAT(there.text, HasSubstr("code 2"));
  folder.profile.base.steps = 0;
  EXPECT_EQ(made(folder.make("base")), "base");
}

TEST_F(Claim, IsKeptAliveAndItsLossEndsTheMake) {
  // The keeper is the one child of make that is no `run`; a hangup makes it look at once.
  const std::string keeper =
      "for p in $(cat /proc/$make/task/$make/children); do tr \"\\0\" \" \" </proc/$p/cmdline | grep -q \" "
      "run \" || kill -HUP "
      "$p; done; ";
  const std::string file = claim().string();
  const ShellResult alive =
      while_at_work("touch -d \"1 hour ago\" " + file + "; " + keeper +
                    "sleep 0.2; echo $(( $(date +%s) - $(stat -c %Y " + file + ") < 60 )) young");
  EXPECT_THAT(alive.text, HasSubstr("1 young"));
  EXPECT_THAT(alive.text, HasSubstr("claim left:\n"));
  const ShellResult lost =
      while_at_work("printf 77.1234@node7 >" + file + "; " + keeper + "wait $make; echo code $?");
  EXPECT_THAT(lost.text, HasSubstr("another make (process 77 on node7) took this folder"));
  EXPECT_THAT(lost.text, Not(HasSubstr("made in")));
  EXPECT_THAT(lost.text, HasSubstr("claim left: 77.1234@node7"));
}

}  // namespace
}  // namespace hbr
