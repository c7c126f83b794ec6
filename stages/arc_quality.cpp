// The stored arcs executed again from fresh starts: what a stored fitness is worth. A search that sees one
// sample keeps lucky draws.
#include "pipeline/core/parallel.h"
#include "stages/evolve.h"

namespace {

void run(hbr::StageRun& stage) {
  const auto s = stage.settings_as<hbr::ArcQualitySlice>();
  const hbr::PlanarArm arm = hbr::make_arm(s.arm);
  const hbr::Frame frame = hbr::make_frame(s);
  const hbr::PointLayer points = hbr::read_points(stage, "layer1", arm, frame);
  const hbr::LineLayer lines = hbr::read_lines(stage, "layer2", frame);
  const hbr::Seed seed = hbr::Seed(s.seed).child(stage.stage()).child(s.replication);

  hbr::Workers workers(stage.threads());
  hbr::Hdf5Writer file(stage.output());
  stage.write_settings(file);
  for (const hbr::ArcVariantTable& variant : s.variants) {
    const hbr::Elites elites = hbr::read_elites(stage.input("layer3_" + variant.name));
    const hbr::ArcEvaluator arcs(points, lines, frame, hbr::arc_controller(variant.controller),
                                 s.fresh_starts, hbr::make_reading(s.reading));
    std::vector<float> fresh(elites.size());
    workers.for_ranges(fresh.size(), 16, [&](std::size_t begin, std::size_t end) {
      arcs.mean_fitness(elites.solution, begin, end, seed.child(variant.name), &fresh[begin]);
    });
    file.write(variant.name + "/stored", {fresh.size()}, elites.objective.data());
    file.write(variant.name + "/fresh", fresh);
  }
  file.close();
}

}  // namespace

int main(int argc, char** argv) { return hbr::stage_main(argc, argv, "Stored arcs from fresh starts", run); }
