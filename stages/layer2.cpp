// Layer 2, lines (paper, section 4.3): displacements of the pen, described by their median over random
// starts.
#include "stages/evolve.h"

namespace {

void run(hbr::StageRun& stage) {
  const auto s = stage.settings_as<hbr::LinesEvolution>();
  const hbr::PlanarArm arm = hbr::make_arm(s.arm);
  const hbr::Frame frame = hbr::make_frame(s);
  const hbr::PointLayer points = hbr::read_points(stage, "layer1", arm, frame);
  const hbr::LineEvaluator lines(points, frame, s.samples);

  evolve(stage, s.search, hbr::fixed_length(2, s.search), lines,
         hbr::Seed(s.seed).child(stage.stage()).child(s.replication));
}

}  // namespace

int main(int argc, char** argv) { return hbr::stage_main(argc, argv, "Layer 2: lines", run); }
