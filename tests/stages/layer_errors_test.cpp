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
  std::vector<Eigen::Vector2d> requests;
  for (int i = 0; i < 40; ++i) requests.push_back(displacement());
  const LineErrors errors = line_errors(original_, other_, requests, kStarts, seed_, workers_);
  ASSERT_EQ(errors.end.size(), 40u * kStarts);
  for (std::size_t i = 0; i < requests.size(); ++i) {
    Rng starts(seed_.child(i));
    for (int s = 0; s < kStarts; ++s) {
      const auto start = static_cast<int>(starts.below(400));
      const auto a = drawn(original_, start, {requests[i]});
      const auto b = drawn(other_, nearest(other_, a[0]), {requests[i]});
      const std::size_t at = i * kStarts + static_cast<std::size_t>(s);
      EXPECT_NEAR(static_cast<double>(errors.end[at]), (a[1] - b[1]).norm(), 1e-6);
      EXPECT_NEAR(static_cast<double>(errors.displacement[at]), (a[1] - a[0] - b[1] + b[0]).norm(), 1e-6);
    }
  }
}

TEST_F(LayerErrors, OfArcsAreThoseOfEveryExecution) {
  std::vector<ArcLines> arcs(30);
  for (ArcLines& arc : arcs)
    for (Eigen::Vector2d& line : arc) line = displacement();
  const ArcErrors errors =
      arc_errors(original_, other_, lines_, arcs, ArcCentre::kCircle, kStarts, seed_, workers_);
  ASSERT_EQ(errors.centre.size(), 30u * kStarts);
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    std::vector<Eigen::Vector2d> requests;
    for (const Eigen::Vector2d& line : arcs[i]) requests.push_back(lines_.request(line));
    Rng starts(seed_.child(i));
    for (int s = 0; s < kStarts; ++s) {
      const auto start = static_cast<int>(starts.below(400));
      const auto a = drawn(original_, start, requests), b = drawn(other_, nearest(other_, a[0]), requests);
      const std::size_t at = i * kStarts + static_cast<std::size_t>(s);
      EXPECT_NEAR(static_cast<double>(errors.end[at]), (a[5] - b[5]).norm(), 1e-6);
      const auto centre = [](const auto& path) -> Eigen::Vector2d {
        const Eigen::Vector2d c = circle_centre(path) - path[0];
        return c.norm() > kFrame.half_side ? Eigen::Vector2d(c.normalized() * kFrame.half_side) : c;
      };
      EXPECT_NEAR(static_cast<double>(errors.centre[at]), (centre(a) - centre(b)).norm(), 1e-6);
      double difference = 0;
      for (std::size_t k = 0; k < 5; ++k) difference += (a[k + 1] - a[k]).norm() - (b[k + 1] - b[k]).norm();
      EXPECT_NEAR(static_cast<double>(errors.length[at]), std::abs(difference), 1e-6);
    }
  }
}

TEST_F(LayerErrors, OverTheSameLayerThereAreNone) {
  const LineErrors lines = line_errors(original_, original_, {displacement()}, 50, seed_, workers_);
  for (const float error : lines.end) EXPECT_EQ(error, 0);
  ArcLines arc;
  arc.fill(displacement());
  const ArcErrors arcs =
      arc_errors(original_, original_, lines_, {arc}, ArcCentre::kCircle, 50, seed_, workers_);
  for (const float error : arcs.centre) EXPECT_EQ(error, 0);
}

}  // namespace
}  // namespace hbr
