// The search for the board of NAO's right arm, from nothing.
#include <benchmark/benchmark.h>

#include <cmath>

#include "models/robot/plane/find_plane.h"
#include "models/robot/plane/robot_on_plane.h"
#include "tests/models/nao/right_arm.h"

namespace hbr {
namespace {

void find_naos_board(benchmark::State& state) {
  constexpr double kRadius = .5815, kHalfSide = .63965;  // m, of the planar arm
  std::vector<Eigen::Vector2d> points;
  for (double x = -kRadius; x <= kRadius; x += .08)
    for (double y = -kRadius; y <= kRadius; y += .08)
      if (std::hypot(x, y) <= kRadius) points.emplace_back(x, y);
  const RobotOnPlane robot = make_robot(nao_right_arm(), DrawingPlane::facing({0, 0, 0}, 0, 0, 1));
  const Clearance clearance(robot.body(), robot.tip());
  const BoardRules rules(clearance, BoardKind::any, floor_under(robot.body()));
  const PlaneSearchSettings settings{"any", false, 50000, 1, 0};
  Workers workers(1);
  for (auto _ : state) {
    const ReachMap map(robot.body(), robot.tip(), clearance, settings.samples, .05, Seed(1), workers);
    const Reach reach(robot.body(), robot.tip(), clearance, 20000, .05, Seed(2));
    benchmark::DoNotOptimize(
        find_plane(robot.body(), rules, map, reach, points, kHalfSide, 1.5e-4, settings, workers));
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()));
}
BENCHMARK(find_naos_board)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace hbr
