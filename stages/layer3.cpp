// Layer 3, arcs (paper, section 4.3): five lines in a row, regular and with joints that contribute alike.
#include "stages/evolve.h"

namespace {

void run(hbr::StageRun& stage) {
  const auto s = stage.settings_as<hbr::ArcsEvolution>();
  const hbr::PlanarArm arm = hbr::make_arm(s.arm);
  const hbr::Frame frame = hbr::make_frame(s);
  const hbr::PointLayer points = hbr::read_points(stage, "layer1", arm, frame);
  const hbr::LineLayer lines = hbr::read_lines(stage, "layer2", frame);
  const hbr::ArcController controller = hbr::arc_controller(s.controller);
  const hbr::ArcEvaluator arcs(points, lines, frame, controller, s.samples, hbr::make_reading(s.reading));

  evolve(stage, s.search, hbr::fixed_length(controller.genes, s.search), arcs,
         hbr::Seed(s.seed).child(stage.stage()).child(s.replication));
}

}  // namespace

int main(int argc, char** argv) { return hbr::stage_main(argc, argv, "Layer 3: arcs", run); }
