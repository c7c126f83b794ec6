// Forward kinematics of the arm.
#include "models/arm/planar_arm.h"

#include <benchmark/benchmark.h>

#include "pipeline/core/random.h"
#include "tests/support/evolved_layers.h"
#include "tests/support/naive_layers.h"

namespace hbr {
namespace {

template <class Arm>
void kinematics(benchmark::State& state) {
  const Eigen::Index n = state.range(0);
  const Arm arm(kLinks, kJointLimit);
  std::vector<double> joints(n * arm.dof());
  Rng rng(Seed(1).child("kinematics"));
  for (double& q : joints) q = kJointLimit * (2 * rng.uniform_double() - 1);
  std::vector<Pen> pens(n);
  for (auto _ : state) {
    arm.pens(n, joints.data(), pens.data());
    benchmark::DoNotOptimize(pens.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * n);
}
BENCHMARK(kinematics<PlanarArm>)->Name("kinematics")->Arg(5)->Arg(25)->Arg(200);
BENCHMARK(kinematics<NaiveArm>)->Name("kinematics_naive")->Arg(200);

}  // namespace
}  // namespace hbr
