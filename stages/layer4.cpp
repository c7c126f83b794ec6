// Layer 4, digits (paper, section 4.3): arcs in a row, placed and judged by a learned descriptor.
#include "stages/descriptors.h"
#include "stages/digit_images.h"
#include "stages/evolve.h"

namespace {

void run(hbr::StageRun& stage) {
  const auto s = stage.settings_as<hbr::DigitsEvolution>();
  const hbr::PlanarArm arm = hbr::make_arm(s.arm);
  const hbr::Frame frame = hbr::make_frame(s);
  const hbr::PointLayer points = hbr::read_points(stage, "layer1", arm, frame);
  const hbr::LineLayer lines = hbr::read_lines(stage, "layer2", frame);
  const hbr::ArcLayer arcs = hbr::read_arcs(stage, "layer3", frame, s.controller);
  const hbr::Hierarchy hierarchy(points, lines, arcs, frame, s.line_spacing,
                                 hbr::out_of_range(s.out_of_range));
  const auto descriptor = hbr::load_descriptor(stage.input("descriptor"));
  const hbr::Pencil pencil = hbr::make_pencil(s.pencil);
  const hbr::DigitEvaluator digits(hierarchy, pencil, *descriptor);

  const hbr::BlockMutation variation(
      hbr::kDigitHead, hbr::kDigitBlock, hbr::kMostArcs, static_cast<float>(s.search.mutation_eta),
      static_cast<float>(s.search.mutation_rate), static_cast<float>(s.length_rate));
  evolve(stage, s.search, variation, digits, hbr::Seed(s.seed).child(stage.stage()).child(s.replication),
         {descriptor->lower().minCoeff(), descriptor->upper().maxCoeff()},
         [&](hbr::Hdf5Writer& file, const hbr::Elites& elites) {
           hbr::write_images(file, elites, [&](const float* genome, int length, float* image) {
             hbr::draw_digit(hierarchy, pencil, genome, length, image);
           });
         });
}

}  // namespace

int main(int argc, char** argv) { return hbr::stage_main(argc, argv, "Layer 4: digits", run); }
