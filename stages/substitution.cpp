// Layer 1 exchanged under a finished hierarchy (paper, section 5.2): the same arcs executed over the original
// and over the substitute, and what becomes of their regularity and of the joints.
#include <array>

#include "pipeline/core/parallel.h"
#include "stages/evolve.h"

namespace {

// M1, M2, M3 of the execution typical of an arc, larger is better.
std::array<float, 3> metrics(const hbr::PointLayer& points, const hbr::ArcOutcome& outcome) {
  return {static_cast<float>(-outcome.irregularity), static_cast<float>(-outcome.joint_cost),
          static_cast<float>(-hbr::mean_joint_cost(points, outcome.waypoints, hbr::few_joints))};
}

void run(hbr::StageRun& stage) {
  const auto s = stage.settings_as<hbr::SubstitutionSlice>();
  const hbr::PlanarArm arm = hbr::make_arm(s.arm);
  const hbr::Frame frame = hbr::make_frame(s);
  const hbr::LineLayer lines = hbr::read_lines(stage, "layer2", frame);
  const hbr::Elites arcs = hbr::read_elites(stage.input("layer3"));
  const hbr::Seed seed = hbr::Seed(s.seed).child(stage.stage()).child(s.replication);

  hbr::Workers workers(stage.threads());
  hbr::Hdf5Writer file(stage.output());
  stage.write_settings(file);
  for (const char* layer : {"original", "substitute"}) {
    const hbr::PointLayer points = hbr::read_points(stage, layer, arm, frame);
    const hbr::ArcEvaluator evaluator(points, lines, frame, hbr::arc_controller(s.variant.controller),
                                      s.variant.samples, hbr::make_reading(s.reading));
    std::vector<float> rows(arcs.size() * 3);
    workers.for_ranges(arcs.size(), 16, [&](std::size_t begin, std::size_t end) {
      std::vector<hbr::ArcOutcome> outcomes(end - begin);
      evaluator.execute(arcs.solution, begin, end, seed.child(layer), outcomes.data());
      for (std::size_t i = begin; i < end; ++i) {
        const auto m = metrics(points, outcomes[i - begin]);
        std::copy(m.begin(), m.end(), &rows[3 * i]);
      }
    });
    file.write(layer, {static_cast<std::size_t>(arcs.size()), 3}, rows.data());
  }
  file.close();
}

}  // namespace

int main(int argc, char** argv) { return hbr::stage_main(argc, argv, "Substitution of layer 1", run); }
