// Lines and arcs over two layers 1, executed again by brute force.
#include "stages/layer_errors.h"

#include <gtest/gtest.h>

#include <numbers>

#include "models/arm/planar_arm.h"

namespace hbr {
namespace {

const Frame kFrame{0.64, 0.25};
const PlanarArm kArm({.1, .2, .28}, std::numbers::pi / 2);
constexpr int kStarts = 3;

// Arms at random.
PointLayer random_points(int n, Seed seed) {
  Rng rng(seed);
  Elites elites;
  elites.solution = Rows(n, 3);
  elites.measures = Rows(n, 2);
  elites.objective.setZero(n);
  for (int i = 0; i < n; ++i) {
    double joints[3];
    for (int k = 0; k < 3; ++k) elites.solution(i, k) = rng.uniform();
    decode_joints(kArm, elites.solution.row(i).data(), joints);
    Pen pen;
    kArm.pens(1, joints, &pen);
    elites.measures.row(i) = kFrame.point_descriptor(pen.position).cast<float>().transpose();
    elites.id.push_back(i);
    elites.parent.push_back(-1);
  }
  return {elites, kArm, kFrame};
}

// Layer 2 without error: the genome's displacement is what it draws.
LineLayer lattice_of_lines() {
  Elites elites;
  const int side = 9;
  elites.solution = elites.measures = Rows(side * side, 2);
  elites.objective.setZero(side * side);
  for (int i = 0; i < side * side; ++i) {
    elites.solution.row(i) << static_cast<float>(i % side) / 8, static_cast<float>(i / side) / 8;
    elites.measures.row(i) = elites.solution.row(i);
    elites.id.push_back(i);
    elites.parent.push_back(-1);
  }
  return {elites, kFrame};
}

int nearest(const PointLayer& points, const Eigen::Vector2d& place) {
  int best = 0;
  for (int i = 1; i < points.size(); ++i)
    if ((points.position(i) - place).norm() < (points.position(best) - place).norm()) best = i;
  return best;
}

std::vector<Eigen::Vector2d> drawn(const PointLayer& points, int start,
                                   const std::vector<Eigen::Vector2d>& requests) {
  std::vector<Eigen::Vector2d> path{points.position(start)};
  for (const Eigen::Vector2d& request : requests)
    path.push_back(points.position(nearest(points, path.back() + request)));
  return path;
}

class LayerErrors : public testing::Test {
 protected:
  PointLayer original_ = random_points(400, Seed(1)), other_ = random_points(300, Seed(2));
  LineLayer lines_ = lattice_of_lines();
  Workers workers_{2};
  Seed seed_ = Seed(3);
  Rng rng_{Seed(4)};

  Eigen::Vector2d displacement() { return {rng_.uniform(-.15f, .15f), rng_.uniform(-.15f, .15f)}; }
};

TEST_F(LayerErrors, OfLinesAreThoseOfEveryExecution) {
  std::vector<LineTask> tasks;
  for (int i = 0; i < 40; ++i) tasks.push_back({displacement(), displacement(), displacement()});
  const LineErrors errors = line_errors(original_, other_, tasks, kStarts, seed_, workers_);
  ASSERT_EQ(errors.end.size(), 40u * kStarts);
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    Rng starts(seed_.child(i));
    for (int s = 0; s < kStarts; ++s) {
      const auto start = static_cast<int>(starts.below(400));
      const auto a = drawn(original_, start, {tasks[i].original});
      const auto b = drawn(other_, nearest(other_, a[0]), {tasks[i].other});
      const std::size_t at = i * kStarts + static_cast<std::size_t>(s);
      EXPECT_NEAR(static_cast<double>(errors.end[at]), (a[1] - b[1]).norm(), 1e-6);
      EXPECT_NEAR(static_cast<double>(errors.displacement[at]), (a[1] - a[0] - b[1] + b[0]).norm(), 1e-6);
      EXPECT_NEAR(static_cast<double>(errors.promise[at]), (b[1] - b[0] - tasks[i].promise).norm(), 1e-6);
    }
  }
}

TEST_F(LayerErrors, OfArcsAreThoseOfEveryExecution) {
  std::vector<ArcTask> tasks(30);
  for (ArcTask& task : tasks) {
    for (Eigen::Vector2d& line : task.original) line = displacement();
    for (Eigen::Vector2d& line : task.other) line = displacement();
    task.promise = {displacement(), 0.5};
  }
  const ArcErrors errors = arc_errors(original_, other_, tasks, ArcCentre::kCircle, kStarts, seed_, workers_);
  ASSERT_EQ(errors.centre.size(), 30u * kStarts);
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const auto listed = [](const ArcTask::Requests& requests) {
      return std::vector<Eigen::Vector2d>(requests.begin(), requests.end());
    };
    Rng starts(seed_.child(i));
    for (int s = 0; s < kStarts; ++s) {
      const auto start = static_cast<int>(starts.below(400));
      const auto a = drawn(original_, start, listed(tasks[i].original)),
                 b = drawn(other_, nearest(other_, a[0]), listed(tasks[i].other));
      const std::size_t at = i * kStarts + static_cast<std::size_t>(s);
      EXPECT_NEAR(static_cast<double>(errors.end[at]), (a[5] - b[5]).norm(), 1e-6);
      const auto centre = [](const auto& path) -> Eigen::Vector2d {
        const Eigen::Vector2d c = circle_centre(path) - path[0];
        return c.norm() > kFrame.half_side ? Eigen::Vector2d(c.normalized() * kFrame.half_side) : c;
      };
      EXPECT_NEAR(static_cast<double>(errors.centre[at]), (centre(a) - centre(b)).norm(), 1e-6);
      double length = 0, other_length = 0;
      for (std::size_t k = 0; k < 5; ++k) {
        length += (a[k + 1] - a[k]).norm();
        other_length += (b[k + 1] - b[k]).norm();
      }
      EXPECT_NEAR(static_cast<double>(errors.length[at]), std::abs(length - other_length), 1e-6);
      EXPECT_NEAR(static_cast<double>(errors.promised_centre[at]),
                  (centre(b) - tasks[i].promise.centre).norm(), 1e-6);
      EXPECT_NEAR(static_cast<double>(errors.promised_length[at]), std::abs(other_length - 0.5), 1e-6);
    }
  }
}

TEST_F(LayerErrors, OverTheSameLayerThereAreNone) {
  const Eigen::Vector2d v = displacement();
  const LineErrors lines = line_errors(original_, original_, {{v, v, v}}, 50, seed_, workers_);
  for (const float error : lines.end) EXPECT_EQ(error, 0);
  ArcTask task;
  task.original.fill(v);
  task.other = task.original;
  const ArcErrors arcs = arc_errors(original_, original_, {task}, ArcCentre::kCircle, 50, seed_, workers_);
  for (const float error : arcs.centre) EXPECT_EQ(error, 0);
}

// Two layers 3 of three arcs each, at places of their own.
ArcLayer few_arcs(float shift) {
  Elites elites;
  elites.solution = elites.measures = Rows(3, 3);
  elites.objective.setZero(3);
  for (int i = 0; i < 3; ++i) {
    const auto at = static_cast<float>(i) / 3 + shift;
    elites.solution.row(i) << at, 0.5f, at;
    elites.measures.row(i) << at, at, 0.5f;
    elites.id.push_back(i);
    elites.parent.push_back(-1);
  }
  return {elites, kFrame, arc_controller("turn")};
}

TEST_F(LayerErrors, TasksAskEachSideAtTheSamePlaces) {
  Rows lines(2, 2), arcs(2, 3);
  lines << 0.3f, 0.6f, 0.9f, 0.5f;
  arcs << 0.1f, 0.2f, 0.5f, 0.7f, 0.6f, 0.4f;
  Elites one;
  one.solution = one.measures = Rows::Constant(1, 2, 0.75f);
  one.objective.setZero(1);
  one.id.push_back(0);
  one.parent.push_back(-1);
  const LineLayer other(one, kFrame);  // whose only line is (0.5, 0.5) rho
  const std::vector<LineTask> asked = line_tasks(kFrame, lines, lines_, other);
  ASSERT_EQ(asked.size(), 2u);
  EXPECT_NEAR((asked[0].promise - Eigen::Vector2d(-0.1, 0.05)).norm(), 0, 1e-7);  // (d - 1/2) 2 rho
  EXPECT_NEAR((asked[1].promise - Eigen::Vector2d(0.2, 0)).norm(), 0, 1e-7);
  for (const LineTask& task : asked) {
    EXPECT_LT((task.original - task.promise).norm(), 0.045) << "the nearest of a lattice of 1/8";
    EXPECT_NEAR((task.other - Eigen::Vector2d(0.125, 0.125)).norm(), 0, 1e-7);
  }

  const ArcLayer here = few_arcs(0), there = few_arcs(0.3f);
  const std::vector<ArcTask> drawn = arc_tasks(kFrame, arcs, {lines_, here}, {other, there});
  ASSERT_EQ(drawn.size(), 2u);
  EXPECT_NEAR((drawn[0].promise.centre - Eigen::Vector2d(-0.512, -0.384)).norm(), 0, 1e-6);  // (d - 1/2) 2 L
  EXPECT_NEAR(drawn[1].promise.length, 0.4 * 5 * 0.25, 1e-6);
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_EQ(drawn[0].original[k], lines_.request(here.lines(0)[k]));  // (0.15, 0.15) is nearest to 0
    EXPECT_EQ(drawn[1].original[k], lines_.request(here.lines(2)[k]));
    EXPECT_EQ(drawn[0].other[k], other.request(there.lines(0)[k]));
  }
}

}  // namespace
}  // namespace hbr
