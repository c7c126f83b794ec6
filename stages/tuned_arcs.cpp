// Fine-tuning of layer 3: the arm's arcs evolve on over another robot's points and lines.
#include "stages/transplant.h"
#include "stages/tuning.h"

namespace {

struct TunedArcs : hbr::ArcsEvolution, hbr::Continued {};
template <class Fields>
void describe(Fields& f, TunedArcs& s) {
  describe(f, static_cast<hbr::ArcsEvolution&>(s));
  describe_continued(f, s);
}

void run(hbr::StageRun& stage) {
  const auto s = stage.settings_as<TunedArcs>();
  const hbr::Frame frame = hbr::make_frame(s);
  const auto robot = hbr::make_drawer(stage, s, s.arm);
  const hbr::PointLayer points = hbr::read_points(stage, "points", *robot, frame);
  const hbr::LineLayer lines = hbr::read_lines(stage, "lines", frame);
  const hbr::ArcController controller = hbr::arc_controller(s.controller);
  const hbr::ArcEvaluator arcs(points, lines, frame, controller, s.samples, hbr::make_reading(s.reading));

  evolve_on(stage, s.search, s.more, hbr::read_elites(stage.input("layer3")),
            hbr::fixed_length(controller.genes, s.search), arcs,
            hbr::Seed(s.seed).child(stage.stage()).child(s.replication));
}

}  // namespace

int main(int argc, char** argv) { return hbr::stage_main(argc, argv, "Arcs evolve on", run); }
