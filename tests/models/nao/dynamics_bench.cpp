// Replays of the right arm's servos: seconds simulated per second of CPU time, the arm alone and the whole
// body.
#include <benchmark/benchmark.h>

#include <cmath>

#include "models/robot/body/servos.h"
#include "tests/models/nao/right_arm.h"

namespace hbr {
namespace {

void dynamics(benchmark::State& state) {
  const bool whole = state.range(0) != 0;
  const RobotModel model = load_urdf(HBR_SOURCE_DIR "/models/nao/nao.urdf");
  const Body body(model, whole ? joints_with_inertia(model, {}, 1e-6) : kRightArm, {},
                  whole ? "l_ankle" : "");
  std::vector<int> drawing;
  for (const std::string& joint : kRightArm)
    drawing.push_back(static_cast<int>(std::find(body.moving().begin(), body.moving().end(), joint) -
                                       body.moving().begin()));
  std::vector<double> joints, times;
  for (int i = 0; i < 100; ++i) {
    times.push_back(0.02 * i);
    for (int k = 0; k < 4; ++k) joints.push_back(0.3 + 0.2 * std::sin(0.1 * i + k));
  }
  const JointPath path(joints, times, 0.05);
  const Eigen::VectorXd posture = body.posture({});
  for (auto _ : state)
    benchmark::DoNotOptimize(replay(body, model.link("r_gripper"), path, drawing, posture, {0.002, 5, 5, 3}));
  state.SetItemsProcessed(
      static_cast<std::int64_t>(std::lround(static_cast<double>(state.iterations()) * path.duration())));
}
BENCHMARK(dynamics)->ArgName("whole")->Arg(0)->Arg(1);

}  // namespace
}  // namespace hbr
