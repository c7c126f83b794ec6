#include "pipeline/artifact/progress.h"

#include <gtest/gtest.h>

#include <limits>

namespace hbr {
namespace {

TEST(Progress, TellsShareRateAndTimeLeft) {
  EXPECT_EQ(progress_text("layer1/03", 4200, 10000, "generations", 103),
            "layer1/03: 4200 of 10000 generations, 42 %, 103/s, 56 s left");
  EXPECT_EQ(progress_text("judge", 9999, 10000, "images", 0.5),
            "judge: 9999 of 10000 images, 99 %, 0.50/s, 2.0 s left");
  EXPECT_EQ(progress_text("judge", 0, 10, "images", 0), "judge: 0 of 10 images, 0 %");
}

TEST(Progress, DurationsReadAsClocks) {
  EXPECT_EQ(duration_text(0), "0.0 s");
  EXPECT_EQ(duration_text(9.94), "9.9 s");
  EXPECT_EQ(duration_text(9.96), "10 s");
  EXPECT_EQ(duration_text(59.4), "59 s");
  EXPECT_EQ(duration_text(59.5), "1:00");
  EXPECT_EQ(duration_text(187), "3:07");
  EXPECT_EQ(duration_text(7387), "2:03:07");
  EXPECT_EQ(duration_text(std::numeric_limits<double>::infinity()), "unknown time");
}

}  // namespace
}  // namespace hbr
