// Arcs or abrupt angles: how the strokes of HBR's digits turn, and those of the flat baseline's, beside what
// the judge says of them.
#include "pipeline/artifact/run_settings.h"
#include "pipeline/core/check.h"
#include "pipeline/hierarchy/layers/arc_geometry.h"
#include "pipeline/hierarchy/layers/flat_digits.h"
#include "stages/layers/read_stack.h"
#include "stages/learned/descriptors.h"
#include "stages/studies/stroke_turns.h"

namespace hbr::inline stages {
namespace {

// `stroke_of` is given a genome and its length, and tells the points between which the pen goes.
template <class StrokeOf>
void write_turns(const Elites& digits, int arc, const Hdf5Reader& judged, const std::string& group,
                 Hdf5Writer& file, StrokeOf&& stroke_of) {
  if (judged.read<std::int64_t>(group + "/id").values != digits.id)
    throw InputError("{}: {}: judges other digits than the repertoire holds; make it again",
                     judged.path().string(), group);
  std::vector<std::int32_t> turns;
  StrokeTurns all;
  std::vector<float> length, side;
  for (Eigen::Index row = 0; row < digits.size(); ++row) {
    const StrokeTurns stroke =
        stroke_turns(stroke_of(digits.solution.row(row).data(), digits.genes(row)), arc);
    turns.push_back(static_cast<std::int32_t>(stroke.turn.size()));
    all.turn.insert(all.turn.end(), stroke.turn.begin(), stroke.turn.end());
    all.joint.insert(all.joint.end(), stroke.joint.begin(), stroke.joint.end());
    length.push_back(stroke.length);
    side.push_back(stroke.side);
  }
  file.write(group + "/id", digits.id);
  file.write(group + "/good", judged.read<std::uint8_t>(group + "/good"));
  file.write(group + "/turns", turns);
  file.write(group + "/turn", all.turn);
  file.write(group + "/joint", all.joint);
  file.write(group + "/length", length);
  file.write(group + "/side", side);
}

void run(StageRun& stage) {
  const StackOnBody stack = read_stack(stage, "layer");
  const std::unique_ptr<Descriptor> descriptor = load_descriptor(stage.input("descriptor"));
  const Hdf5Reader judged(stage.input("digits"));
  Hdf5Writer file(stage.output());
  stage.write_settings(file);

  const Executor& executor = *stack.top().executor();
  write_turns(stack.elites.back(), kArcSegments, judged, "hbr", file,
              [&](const float* genome, int length) { return stops_of(executor, genome, length); });
  StackOnBody none;
  const StoredLayer flat = read_layer(stage, "flat", none, descriptor.get());
  const FlatDigits& digits = flat_digits_of(*flat.model);
  write_turns(flat.elites, 0, judged, "flat", file,
              [&](const float* genome, int length) { return digits.tips(genome, length); });
  file.close();
}

}  // namespace
}  // namespace hbr::inline stages

int main(int argc, char** argv) {
  return hbr::stage_main(argc, argv, "How the digits' strokes turn", hbr::run);
}
