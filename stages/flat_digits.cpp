// The flat baseline of section 5.1: digits by configurations of all joints, judged by the same descriptor.
#include "stages/descriptors.h"
#include "stages/digit_images.h"
#include "stages/evolve.h"

namespace {

void run(hbr::StageRun& stage) {
  const auto s = stage.settings_as<hbr::FlatDigitsEvolution>();
  const hbr::PlanarArm arm = hbr::make_arm(s.arm);
  const auto descriptor = hbr::load_descriptor(stage.input("descriptor"));
  const hbr::FlatDigits flat(arm, hbr::Frame{s.half_side, 0}, hbr::make_pencil(s.pencil),
                             hbr::flat_digit_reading(s.pen, s.start));
  const hbr::FlatDigitEvaluator digits(flat, *descriptor);

  const hbr::BlockMutation variation(
      hbr::FlatDigits::kHead, flat.block(), hbr::kMostArcs, static_cast<float>(s.search.mutation_eta),
      static_cast<float>(s.search.mutation_rate), static_cast<float>(s.length_rate));
  evolve(stage, s.search, variation, digits, hbr::Seed(s.seed).child(stage.stage()).child(s.replication),
         {descriptor->lower().minCoeff(), descriptor->upper().maxCoeff()},
         [&](hbr::Hdf5Writer& file, const hbr::Elites& elites) {
           hbr::write_images(file, elites, [&](const float* genome, int length, float* image) {
             flat.draw_digits(1, genome, 0, &length, image);
           });
         });
}

}  // namespace

int main(int argc, char** argv) { return hbr::stage_main(argc, argv, "Flat baseline: digits", run); }
