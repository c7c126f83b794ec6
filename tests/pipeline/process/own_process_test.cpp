#include "pipeline/process/own_process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <new>
#include <vector>

#include "pipeline/core/check.h"

namespace hbr {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
using testing::ThrowsMessage;

const OwnProcess kSmall{std::size_t{256} << 20, 1};

TEST(OwnProcess, HandsBackWhatTheWorkReturns) {
  EXPECT_EQ(kSmall.run("a", [] { return std::string(); }), "");
  std::string long_text;  // more than a pipe holds
  for (unsigned i = 0; i < 3000000; ++i) long_text += static_cast<char>(i * i);
  EXPECT_EQ(kSmall.run("a", [&] { return long_text; }), long_text);
}

TEST(OwnProcess, TellsWhyThereIsNothing) {
  const auto run = [](const std::function<void()>& work) {
    return [work] {
      kSmall.run("file.obj", [&] {
        work();
        return std::string("done");
      });
    };
  };
  EXPECT_THAT(run([] { throw InputError("no triangle\nat all"); }),
              ThrowsMessage<InputError>("file.obj: no triangle"));
  EXPECT_THROW(run([] { std::raise(SIGKILL); })(), std::bad_alloc);  // as a kernel does without memory
  EXPECT_THAT(run([] { std::abort(); }),
              ThrowsMessage<InputError>(HasSubstr("file.obj: the reader crashed")));
  EXPECT_THAT(run([] { _exit(0); }), ThrowsMessage<InputError>(HasSubstr("file.obj: the reader crashed")));
  // Looked at: a compiler may leave out what nobody looks at.
  const auto fill = [] {
    const std::vector<char> much(std::size_t{4} << 30, 'a');
    volatile char seen = much[much.size() / 2];
    static_cast<void>(seen);
  };
  EXPECT_THAT(run(fill), ThrowsMessage<InputError>(StartsWith("file.obj: ")));
  EXPECT_THAT(run([] {
                static volatile std::sig_atomic_t forever = 1;
                while (forever) {
                }
              }),
              ThrowsMessage<InputError>(HasSubstr("file.obj: reading it does not end within 1 s")));
}

}  // namespace
}  // namespace hbr
