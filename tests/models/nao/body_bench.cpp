// Pens per second of CPU time: what the evolution of NAO's layer 1 costs.
#include "models/robot/plane/robot_on_plane.h"

#include <benchmark/benchmark.h>

#include "pipeline/core/random.h"

namespace hbr {
namespace {

void hand_positions(benchmark::State& state) {
  const auto body = std::make_shared<const Body>(
      load_urdf(HBR_SOURCE_DIR "/models/nao/nao.urdf"),
      std::vector<std::string>{"RShoulderPitch", "RShoulderRoll", "RElbowYaw", "RElbowRoll"});
  const RobotOnPlane robot("nao", body, "r_gripper",
                           DrawingPlane::facing({.1427, -.1524, .0902}, -.38, -.07, .258));
  const int n = 200;
  std::vector<double> joints(4 * n);
  Rng rng(Seed(1).child("bench"));
  for (double& q : joints) q = rng.uniform(0.1f, 1.f);
  std::vector<Pen> pens(n);
  for (auto _ : state) {
    robot.pens(n, joints.data(), pens.data());
    benchmark::DoNotOptimize(pens.data());
  }
  state.SetItemsProcessed(state.iterations() * n);
}
BENCHMARK(hand_positions);

}  // namespace
}  // namespace hbr
