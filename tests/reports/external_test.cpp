#include "reports/external.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/core/check.h"

namespace hbr {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(External, PassesInputAndOutputUnchanged) {
  std::string bytes;
  for (unsigned i = 0; i < 1000000; ++i)
    bytes += static_cast<char>(i * 7919 >> 3);        // more than any pipe holds
  EXPECT_TRUE(run_program({"cat"}, bytes) == bytes);  // without printing a megabyte
}

TEST(External, KnowsNoShell) { EXPECT_EQ(run_program({"echo", "$HOME; *", "a b"}, ""), "$HOME; * a b\n"); }

TEST(External, HidesPlaceAndTime) {
  const std::string seen = run_program({"env"}, "");
  EXPECT_THAT(seen, HasSubstr("SOURCE_DATE_EPOCH=0\n"));
  EXPECT_THAT(seen, HasSubstr("LC_ALL=C.UTF-8\n"));
}

TEST(External, TellsWhatWentWrong) {
  EXPECT_THAT([] { run_program({"no-such-program-here"}, ""); },
              ThrowsMessage<InputError>(HasSubstr("cannot start no-such-program-here")));
  EXPECT_THAT(
      [] {
        run_program({"ls", "/no/such/folder"}, "");
      },
      ThrowsMessage<InputError>(
          testing::AllOf(HasSubstr("ls failed with exit code 2"), HasSubstr("/no/such/folder"))));
  EXPECT_THAT(
      [] {
        run_program({"sh", "-c", "kill -9 $$"}, "");
      },
      ThrowsMessage<InputError>(HasSubstr("ended by signal 9")));
  EXPECT_THAT(
      [] {
        run_program({"gnuplot", "-d", "-"}, "plot nonsense here\n");
      },
      ThrowsMessage<InputError>(HasSubstr("gnuplot failed")));
}

}  // namespace
}  // namespace hbr
