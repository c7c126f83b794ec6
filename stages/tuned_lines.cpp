// Fine-tuning of layer 2: the arm's lines evolve on over another robot's points.
#include "stages/transplant.h"
#include "stages/tuning.h"

namespace {

struct TunedLines : hbr::LinesEvolution, hbr::Continued {};
template <class Fields>
void describe(Fields& f, TunedLines& s) {
  describe(f, static_cast<hbr::LinesEvolution&>(s));
  describe_continued(f, s);
}

void run(hbr::StageRun& stage) {
  const auto s = stage.settings_as<TunedLines>();
  const hbr::Frame frame = hbr::make_frame(s);
  const auto robot = hbr::make_drawer(stage, s, s.arm);
  const hbr::PointLayer points = hbr::read_points(stage, "points", *robot, frame);
  const hbr::LineEvaluator lines(points, frame, s.samples);

  evolve_on(stage, s.search, s.more, hbr::read_elites(stage.input("layer2")), hbr::fixed_length(2, s.search),
            lines, hbr::Seed(s.seed).child(stage.stage()).child(s.replication));
}

}  // namespace

int main(int argc, char** argv) { return hbr::stage_main(argc, argv, "Lines evolve on", run); }
