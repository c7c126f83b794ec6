// Layer 1, points (paper, section 4.3): every place that the pen can reach, its joints contributing alike;
// or, as the substitute of section 5.2, only two of them moving.
#include "stages/evolve.h"

namespace {

void run(hbr::StageRun& stage) {
  const auto s = stage.settings_as<hbr::PointsEvolution>();
  const hbr::PlanarArm arm = hbr::make_arm(s.arm);
  const hbr::Frame frame{s.half_side, 0};
  const hbr::PointEvaluator points(arm, frame, hbr::joint_cost(s.cost), 0);

  evolve(stage, s.search, hbr::fixed_length(static_cast<int>(arm.dof()), s.search), points,
         hbr::Seed(s.seed).child(stage.stage()).child(s.replication));
}

}  // namespace

int main(int argc, char** argv) { return hbr::stage_main(argc, argv, "Layer 1: points", run); }
