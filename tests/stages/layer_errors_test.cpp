// Lines and arcs over two layers 1, executed again by brute force.
#include "stages/studies/layer_errors.h"

#include <gtest/gtest.h>

#include <numbers>

#include "models/arm/planar_arm.h"
#include "pipeline/hierarchy/layers/arcs.h"
#include "pipeline/hierarchy/layers/lines.h"
#include "pipeline/hierarchy/layers/points.h"

namespace hbr {
namespace {

constexpr double kHalfSide = 0.64, kLongestLine = 0.25;
const Frame kFrame{kHalfSide, kLongestLine};
const PlanarArm kArm({.1, .2, .28}, std::numbers::pi / 2);
constexpr int kStarts = 3;

Elites random_elites(int n, int genes, int descriptor_size, Rng& rng) {
  Elites elites;
  elites.solution = Rows::NullaryExpr(n, genes, [&] { return rng.uniform(); });
  elites.measures = Rows::NullaryExpr(n, descriptor_size, [&] { return rng.uniform(); });
  elites.objective.setZero(n);
  for (int i = 0; i < n; ++i) {
    elites.id.push_back(i);
    elites.parent.push_back(-1);
  }
  return elites;
}

int nearest(const Rows& rows, const Eigen::VectorXd& to) {
  Eigen::Index best = 0;
  (rows.cast<double>().rowwise() - to.transpose()).rowwise().squaredNorm().minCoeff(&best);
  return static_cast<int>(best);
}

// Points, lines and arcs at random, and what becomes of a request by their arrays alone.
struct Hierarchy {
  Elites points, lines, arcs;
  Stack stack;

  Hierarchy(int n, Seed seed) {
    Rng rng(seed);
    points = random_elites(n, 3, 2, rng);
    for (int i = 0; i < n; ++i) {
      double joints[3];
      decode_joints(kArm, points.solution.row(i).data(), joints);
      Pen pen;
      kArm.pens(1, joints, &pen);
      points.measures.row(i) = kFrame.point_descriptor(pen.position).cast<float>().transpose();
    }
    lines = random_elites(50, 2, 2, rng);
    arcs = random_elites(40, 3, 3, rng);
    stack.add(make_points({kHalfSide, "joint_variance"}, {kArm}), points);
    stack.add(make_lines({{kLongestLine, "disc"}, 10}, {kArm, &stack}), lines);
    stack.add(make_arcs({{"circle", "mean"}, "turn", 10}, {kArm, &stack}), arcs);
  }
  Side side(int level) const { return {stack.points(), stack.layer(level)}; }

  Eigen::Vector2d position(int elite) const {
    return kFrame.point(points.measures.row(elite).transpose().cast<double>());
  }
  int start_at(const Eigen::Vector2d& place) const {
    return nearest(points.measures, kFrame.point_descriptor(place));
  }
  void draw_line(const Eigen::Vector2d& descriptor, std::vector<Eigen::Vector2d>& path) const {
    const int line = nearest(lines.measures, descriptor);
    path.push_back(position(start_at(path.back() + decode_line(kFrame, lines.solution.row(line).data()))));
  }
  std::vector<Eigen::Vector2d> line(int start, const Rows& command) const {
    std::vector<Eigen::Vector2d> path{position(start)};
    draw_line(command.row(0).transpose().cast<double>(), path);
    return path;
  }
  std::vector<Eigen::Vector2d> arc(int start, const Rows& command) const {
    std::vector<Eigen::Vector2d> path{position(start)};
    const int arc = nearest(arcs.measures, command.row(0).transpose().cast<double>());
    for (const Eigen::Vector2d& wanted : arc_controllers()[1].decode(kFrame, arcs.solution.row(arc).data()))
      draw_line(kFrame.line_descriptor(wanted), path);
    return path;
  }
};

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
  const ArcErrors errors = arc_errors(kFrame, commands, original_.side(2), other_.side(2), ArcCentre::kCircle,
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
  const ArcErrors arcs = arc_errors(kFrame, commands(5, 3), original_.side(2), original_.side(2),
                                    ArcCentre::kCircle, 50, seed_, workers_);
  for (const float error : arcs.centre) EXPECT_EQ(error, 0);
}

}  // namespace
}  // namespace hbr
