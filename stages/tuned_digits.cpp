// Fine-tuning of layer 4: the arm's digits evolve on over another robot's points, and lines and arcs of the
// arm or of that robot.
#include "stages/descriptors.h"
#include "stages/digit_images.h"
#include "stages/transplant.h"
#include "stages/tuning.h"

namespace {

struct TunedDigits : hbr::DigitsEvolution, hbr::Continued {};
template <class Fields>
void describe(Fields& f, TunedDigits& s) {
  describe(f, static_cast<hbr::DigitsEvolution&>(s));
  describe_continued(f, s);
}

void run(hbr::StageRun& stage) {
  const auto s = stage.settings_as<TunedDigits>();
  const hbr::Frame frame = hbr::make_frame(s);
  const auto robot = hbr::make_drawer(stage, s, s.arm);
  const hbr::PointLayer points = hbr::read_points(stage, "points", *robot, frame);
  const hbr::LineLayer lines = hbr::read_lines(stage, "lines", frame);
  const hbr::ArcLayer arcs = hbr::read_arcs(stage, "arcs", frame, s.controller);
  const hbr::Hierarchy hierarchy(points, lines, arcs, frame, s.line_spacing,
                                 hbr::out_of_range(s.out_of_range));
  const auto descriptor = hbr::load_descriptor(stage.input("descriptor"));
  const hbr::Pencil pencil = hbr::make_pencil(s.pencil);
  const hbr::DigitEvaluator digits(hierarchy, pencil, *descriptor);

  const hbr::BlockMutation variation(
      hbr::kDigitHead, hbr::kDigitBlock, hbr::kMostArcs, static_cast<float>(s.search.mutation_eta),
      static_cast<float>(s.search.mutation_rate), static_cast<float>(s.length_rate));
  evolve_on(stage, s.search, s.more, hbr::read_elites(stage.input("layer4")), variation, digits,
            hbr::Seed(s.seed).child(stage.stage()).child(s.replication),
            {descriptor->lower().minCoeff(), descriptor->upper().maxCoeff()},
            [&](hbr::Hdf5Writer& file, const hbr::Elites& elites) {
              hbr::write_images(file, elites, [&](const float* genome, int length, float* image) {
                hbr::draw_digit(hierarchy, pencil, genome, length, image);
              });
            });
}

}  // namespace

int main(int argc, char** argv) { return hbr::stage_main(argc, argv, "Digits evolve on", run); }
