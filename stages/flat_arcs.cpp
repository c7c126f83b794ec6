// The flat baseline of section 5.4: arcs by five configurations of all joints, without a hierarchy.
#include "stages/evolve.h"

namespace {

void run(hbr::StageRun& stage) {
  const auto s = stage.settings_as<hbr::FlatArcsEvolution>();
  const hbr::PlanarArm arm = hbr::make_arm(s.arm);
  const hbr::FlatArcEvaluator arcs(arm, hbr::make_frame(s), hbr::flat_start(s.start),
                                   hbr::make_reading(s.reading));

  evolve(stage, s.search, hbr::fixed_length(arcs.genes(), s.search), arcs,
         hbr::Seed(s.seed).child(stage.stage()).child(s.replication));
}

}  // namespace

int main(int argc, char** argv) { return hbr::stage_main(argc, argv, "Flat baseline: arcs", run); }
