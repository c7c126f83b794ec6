#include "pipeline/artifact/tally.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

struct Out : TemporaryFolder {
  Out() { std::filesystem::create_directory(path() / ".plan"); }
};

TEST(Tally, CountsWhatIsMadeAndTellsTheTimeLeftByStage) {
  const Out out;
  std::vector<std::string> stages(10, "short");
  stages.insert(stages.end(), 10, "long");
  start_tally(out.path(), stages, 1000);
  EXPECT_EQ(count_made(out.path(), "short", 1, 1001), "1 of 20");
  // One a second, by one of two processors all the time; those of the other stage count as the mean of all.
  EXPECT_EQ(count_made(out.path(), "short", 1, 1001), "2 of 20, about 9.0 s left");
  // Long ones take 31 seconds each, two side by side: 8 short and 9 long are left, 287 s of one processor.
  EXPECT_EQ(count_made(out.path(), "long", 31, 1016.5), "3 of 20, about 2:24 left");
  for (int i = 0; i < 8; ++i) count_made(out.path(), "short", 1, 1020);
  for (int i = 0; i < 8; ++i) count_made(out.path(), "long", 31, 1150);
  EXPECT_EQ(count_made(out.path(), "long", 31, 1160), "20 of 20");
  start_tally(out.path(), {"short"}, 2000);
  EXPECT_EQ(count_made(out.path(), "short", 1, 2001), "1 of 1");
}

TEST(Tally, IsSilentWhereNoMakeCounts) {
  const Out out;
  EXPECT_EQ(count_made(out.path(), "short", 1, 1001), "");
  EXPECT_FALSE(std::filesystem::exists(out.path() / ".plan/tally"));
}

}  // namespace
}  // namespace hbr
