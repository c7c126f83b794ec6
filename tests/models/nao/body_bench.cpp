// Hand positions per second of CPU time: what the evolution of NAO's layer 1 costs.
#include "models/simbody/body.h"

#include <benchmark/benchmark.h>

#include "pipeline/core/random.h"

namespace hbr {
namespace {

void hand_positions(benchmark::State& state) {
  const Body body(load_urdf(HBR_SOURCE_DIR "/models/nao/nao.urdf"),
                  {"RShoulderPitch", "RShoulderRoll", "RElbowYaw", "RElbowRoll"});
  const int tip = body.model().link("r_gripper"), n = 200;
  std::vector<double> joints(4 * n);
  Rng rng(Seed(1).child("bench"));
  for (double& q : joints) q = rng.uniform(0.1f, 1.f);
  std::vector<Eigen::Vector3d> hands(n);
  for (auto _ : state) {
    body.positions(tip, n, joints.data(), hands.data());
    benchmark::DoNotOptimize(hands.data());
  }
  state.SetItemsProcessed(state.iterations() * n);
}
BENCHMARK(hand_positions);

}  // namespace
}  // namespace hbr
