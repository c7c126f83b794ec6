// Lines and arcs over two layers 1, executed again by brute force.
#include "stages/studies/layer_errors.h"

#include <gtest/gtest.h>

#include "tests/stages/random_hierarchy.h"

namespace hbr {
namespace {

constexpr int kStarts = 3;

class LayerErrors : public testing::Test {
 protected:
  Hierarchy original_{400, Seed(1)}, other_{300, Seed(2)};
  Workers workers_{2};
  Seed seed_ = Seed(3);
  Rng rng_{Seed(4)};
  Rows commands(int n, int d) {
    return Rows::NullaryExpr(n, d, [&] { return rng_.uniform(); });
  }
};

TEST_F(LayerErrors, OfLinesAreThoseOfEveryExecution) {
  const Rows commands = this->commands(40, 2);
  const LineErrors errors =
      line_errors(kFrame, commands, original_.side(1), other_.side(1), kStarts, seed_, workers_);
  ASSERT_EQ(errors.end.size(), 40u * kStarts);
  for (int i = 0; i < 40; ++i) {
    Rng starts(seed_.child(static_cast<std::uint64_t>(i)));
    const Eigen::Vector2d promise = kFrame.line(commands.row(i).transpose().cast<double>());
    for (int s = 0; s < kStarts; ++s) {
      const auto start = static_cast<int>(starts.below(400));
      const auto a = original_.line(start, commands.row(i));
      const auto b = other_.line(other_.start_at(a[0]), commands.row(i));
      const auto at = static_cast<std::size_t>(i * kStarts + s);
      EXPECT_NEAR(static_cast<double>(errors.end[at]), (a[1] - b[1]).norm(), 1e-6);
      EXPECT_NEAR(static_cast<double>(errors.displacement[at]), (a[1] - a[0] - b[1] + b[0]).norm(), 1e-6);
      EXPECT_NEAR(static_cast<double>(errors.promise[at]), (b[1] - b[0] - promise).norm(), 1e-6);
    }
  }
}

TEST_F(LayerErrors, OfArcsAreThoseOfEveryExecution) {
  const Rows commands = this->commands(30, 3);
  const ArcErrors errors = arc_errors(original_.stack.model(2), commands, original_.side(2), other_.side(2),
                                      kStarts, seed_, workers_);
  ASSERT_EQ(errors.centre.size(), 30u * kStarts);
  for (int i = 0; i < 30; ++i) {
    Rng starts(seed_.child(static_cast<std::uint64_t>(i)));
    const Eigen::Vector3d asked = commands.row(i).transpose().cast<double>();
    for (int s = 0; s < kStarts; ++s) {
      const auto start = static_cast<int>(starts.below(400));
      const auto a = original_.arc(start, commands.row(i)),
                 b = other_.arc(other_.start_at(a[0]), commands.row(i));
      const auto at = static_cast<std::size_t>(i * kStarts + s);
      EXPECT_NEAR(static_cast<double>(errors.end[at]), (a[5] - b[5]).norm(), 1e-6);
      const auto centre = [](const auto& path) -> Eigen::Vector2d {
        const Eigen::Vector2d c = circle_centre(path) - path[0];
        return c.norm() > kHalfSide ? Eigen::Vector2d(c.normalized() * kHalfSide) : c;
      };
      EXPECT_NEAR(static_cast<double>(errors.centre[at]), (centre(a) - centre(b)).norm(), 1e-6);
      double length = 0, other_length = 0;
      for (std::size_t k = 0; k < 5; ++k) {
        length += (a[k + 1] - a[k]).norm();
        other_length += (b[k + 1] - b[k]).norm();
      }
      EXPECT_NEAR(static_cast<double>(errors.length[at]), std::abs(length - other_length), 1e-6);
      EXPECT_NEAR(static_cast<double>(errors.promised_centre[at]),
                  (centre(b) - kFrame.point(asked.head<2>())).norm(), 1e-6);
      EXPECT_NEAR(static_cast<double>(errors.promised_length[at]),
                  std::abs(other_length - asked.z() * 5 * kLongestLine), 1e-6);
    }
  }
}

TEST_F(LayerErrors, OverTheSameLayerThereAreNone) {
  const LineErrors lines =
      line_errors(kFrame, commands(5, 2), original_.side(1), original_.side(1), 50, seed_, workers_);
  for (const float error : lines.end) EXPECT_EQ(error, 0);
  const ArcErrors arcs = arc_errors(original_.stack.model(2), commands(5, 3), original_.side(2),
                                    original_.side(2), 50, seed_, workers_);
  for (const float error : arcs.centre) EXPECT_EQ(error, 0);
}

}  // namespace
}  // namespace hbr
