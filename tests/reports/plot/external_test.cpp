#include "reports/plot/external.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/core/check.h"

namespace hbr {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(External, KnowsNoShell) { EXPECT_EQ(run_program({"echo", "$HOME; *", "a b"}, ""), "$HOME; * a b\n"); }

TEST(External, HidesPlaceAndTime) {
  const std::string seen = run_program({"env"}, "");
  EXPECT_THAT(seen, HasSubstr("SOURCE_DATE_EPOCH=0\n"));
  EXPECT_THAT(seen, HasSubstr("LC_ALL=C.UTF-8\n"));
}

TEST(External, TellsWhatWentWrong) {
  EXPECT_THAT([] { run_program({"no-such-program-here"}, ""); },
              ThrowsMessage<InputError>(HasSubstr("can't start no-such-program-here")));
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
