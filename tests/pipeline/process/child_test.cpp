#include "pipeline/process/child.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <system_error>

#include "pipeline/core/check.h"
#include "pipeline/process/bytes.h"
#include "pipeline/process/identity.h"
#include "pipeline/process/output.h"
#include "pipeline/process/run_child.h"

namespace hbr {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(Child, EndsAsItsWorkSays) {
  EXPECT_EQ(wait_for(start_work([] { return 7; })).exit_code, 7);
  const Ending killed = wait_for(start_work([] { return std::raise(SIGKILL); }));
  EXPECT_EQ(killed.exit_code, -1);
  EXPECT_EQ(killed.signal, SIGKILL);
}

TEST(Child, IsAProgramThatIsThere) {
  EXPECT_EQ(wait_for(start_program({{"sh", "-c", "exit 3"}})).exit_code, 3);
  EXPECT_THAT([] { start_program({{"no-such-program-here"}}); },
              ThrowsMessage<InputError>(HasSubstr("can't start no-such-program-here: No such file")));
  EXPECT_THAT([] { start_program({{"/dev/null"}}); },
              ThrowsMessage<InputError>(HasSubstr("can't start /dev/null: Permission denied")));
}

// What the machine lacks is not the fault of what was to be started.
TEST(Child, WithoutResourcesIsNoInputError) {
  const Ending ending = wait_for(start_work([] {
    rlimit before{};
    ::getrlimit(RLIMIT_NOFILE, &before);
    const rlimit none{0, before.rlim_max};
    ::setrlimit(RLIMIT_NOFILE, &none);
    try {
      start_program({{"true"}});
    } catch (const std::system_error& error) {
      ::setrlimit(RLIMIT_NOFILE, &before);  // a sanitizer opens files to look at the exception
      return error.code() == std::errc::too_many_files_open ? 0 : 2;
    }
    return 1;
  }));
  EXPECT_EQ(ending.exit_code, 0);
}

TEST(Child, BeginsWithNoSignalBlocked) {
  sigset_t all, before;
  sigfillset(&all);
  ::sigprocmask(SIG_BLOCK, &all, &before);
  EXPECT_EQ(wait_for(start_program({{"sh", "-c", "kill -TERM $$; exit 0"}})).signal, SIGTERM);
  ::sigprocmask(SIG_SETMASK, &before, nullptr);
}

// A middle process starts one that would sleep for long, says which, and is killed.
TEST(Child, DoesNotOutliveItsParent) {
  int told[2];
  ASSERT_EQ(::pipe(told), 0);
  const int middle = start_work([&] {
    const int child = start_program({{"sleep", "600"}});
    write_all(told[1], std::to_string(child));
    ::close(told[1]);  // `sleep` still has it
    return std::raise(SIGKILL);
  });
  ::close(told[1]);
  EXPECT_EQ(wait_for(middle).signal, SIGKILL);
  EXPECT_NE(read_all(told[0]), "");  // comes to its end when nobody has the other end any more
  ::close(told[0]);
}

TEST(Output, IsWhatTheProgramSays) {
  std::string bytes;
  for (unsigned i = 0; i < 1000000; ++i)
    bytes += static_cast<char>(i * 7919 >> 3);             // more than any pipe holds
  EXPECT_TRUE(output_of({{"cat"}}, bytes).text == bytes);  // without printing a megabyte
  const Output output = output_of({{"sh", "-c", "echo one; echo two >&2; exit 4"}});
  EXPECT_EQ(output.text, "one\n");
  EXPECT_EQ(output.errors, "two\n");
  EXPECT_EQ(output.ending.exit_code, 4);
}

TEST(Output, IsOfTheEnvironmentThatIsGiven) {
  EXPECT_EQ(output_of({{"env"}, {"HBR_COLOUR=blue", "HBR_SIZE=3"}}).text, "HBR_COLOUR=blue\nHBR_SIZE=3\n");
  ::setenv("HBR_COLOUR", "red", 1);
  EXPECT_EQ(output_of({{"printenv", "HBR_COLOUR"}}).text, "red\n");
}

// The files take the numbers of those that are closed.
TEST(Output, IsToldWithoutAStandardInputToo) {
  const Ending ending = wait_for(start_work([] {
    ::close(STDIN_FILENO);
    return output_of({{"cat"}}, "told").text == "told" ? 0 : 1;
  }));
  EXPECT_EQ(ending.exit_code, 0);
}

// nohup make &
TEST(RunChild, IgnoresWhatItsProcessIgnores) {
  const Ending ending = wait_for(start_work([] {
    std::signal(SIGHUP, SIG_IGN);
    const ChildResult result = run_child({"sh", "-c", "kill -HUP $PPID; exit 5"});
    return result.exit_code == 5 && !result.stopped ? 0 : 1;
  }));
  EXPECT_EQ(ending.exit_code, 0);
}

// In a process of its own: whoever was asked to end starts nothing any more.
TEST(RunChild, HandsSignalsOnAndThenRunsNothing) {
  const Ending ending = wait_for(start_work([] {
    const ChildResult first = run_child({"sh", "-c", "kill -TERM $PPID; exec sleep 600"}),
                      second = run_child({"sh", "-c", "exit 5"});
    return first.signal == SIGTERM && first.stopped && second.signal == SIGTERM && second.stopped ? 0 : 1;
  }));
  EXPECT_EQ(ending.exit_code, 0);
  EXPECT_EQ(run_child({"sh", "-c", "exit 5"}).exit_code, 5);
}

}  // namespace
}  // namespace hbr
