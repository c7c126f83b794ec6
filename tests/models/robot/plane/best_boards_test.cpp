// On a chain in a plane, whose largest squares have a closed form.
#include "models/robot/plane/best_boards.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/core/check.h"
#include "tests/models/robot/plane/three_links.h"

namespace hbr {
namespace {

// The half disc of 3 m above the floor holds a square of side s with (s / 2)^2 + s^2 = 9.
TEST(BestBoards, TheLargestSquareOfAHalfDisc) {
  Workers workers(1);
  const auto boards =
      best_boards(three_links().body().model(), {"j0", "j1", "j2"}, {}, three_links().tip(), 100000, workers);
  ASSERT_EQ(boards.size(), 3u);
  EXPECT_STREQ(board_kind_name(boards[1].kind), "upright");
  ASSERT_TRUE(boards[1].board);
  const DrawingPlane& plane = boards[1].board->plane;
  EXPECT_NEAR(2 * plane.scale, 3 / std::sqrt(1.25), 0.25);
  EXPECT_NEAR(std::abs(plane.normal().x()), 1, 0.05);
  EXPECT_GE(plane.origin.z() - plane.scale, -1e-9);
  for (const std::size_t other : {0, 2}) {  // a slice of the plane's thickness at most
    EXPECT_STREQ(board_kind_name(boards[other].kind), other == 0 ? "level" : "leaning");
    if (boards[other].board) {
      EXPECT_LT(boards[other].board->plane.scale, plane.scale / 3);
      EXPECT_EQ(board_kind(boards[other].board->plane), boards[other].kind);
    }
  }
}

TEST(BestBoards, AskForAJointThatMovesTheTip) {
  Workers workers(1);
  const RobotModel& model = three_links().body().model();
  EXPECT_THAT([&] { best_boards(model, {"j2"}, {}, model.link("link1"), 1000, workers); },
              testing::ThrowsMessage<InputError>(testing::HasSubstr("no joint moves 'link1'")));
}

}  // namespace
}  // namespace hbr
