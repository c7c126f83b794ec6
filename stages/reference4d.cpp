// The reference of section 5.3: lines described by where they start and where they lead, without a stochastic
// descriptor.
#include "stages/evolve.h"

namespace {

void run(hbr::StageRun& stage) {
  const auto s = stage.settings_as<hbr::LinesEvolution>();
  const hbr::PlanarArm arm = hbr::make_arm(s.arm);
  const hbr::Frame frame = hbr::make_frame(s);
  const hbr::PointLayer points = hbr::read_points(stage, "layer1", arm, frame);
  const hbr::LineFromStartEvaluator lines(points, frame);

  evolve(stage, s.search, hbr::fixed_length(2, s.search), lines,
         hbr::Seed(s.seed).child(stage.stage()).child(s.replication));
}

}  // namespace

int main(int argc, char** argv) {
  return hbr::stage_main(argc, argv, "Reference: lines with a four-dimensional descriptor", run);
}
