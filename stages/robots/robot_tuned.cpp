// What fine-tuning gains (paper, section 5.2, as an outlook): the arm's lines, arcs and digits as another
// robot draws them before and after its layers evolved on, asked for at the same places. With the arm in the
// robot's place: what more generations gain by themselves.
#include "models/judge/judge.h"
#include "pipeline/artifact/run_settings.h"
#include "pipeline/core/parallel.h"
#include "pipeline/drawing/image_difference.h"
#include "pipeline/hierarchy/layers.h"
#include "pipeline/hierarchy/layers/arcs.h"
#include "pipeline/qd/places.h"
#include "stages/layers/images.h"
#include "stages/layers/read_stack.h"
#include "stages/layers/warm_start.h"
#include "stages/learned/descriptors.h"
#include "stages/robots/robot_tasks.h"
#include "stages/studies/layer_errors.h"

namespace hbr::inline stages {
namespace {

struct TunedSlice : RunTable {
  double line_places = 0, arc_places = 0;
  TransferTable transfer;
};
template <class Fields>
void describe(Fields& f, TunedSlice& s) {
  describe_run(f, s);
  f.number("line_places", s.line_places, Range{0, 10}, "how far from the arm's lines lines are asked for");
  f.number("arc_places", s.arc_places, Range{0, 10}, "how far from the arm's arcs arcs are asked for");
  f.table("transfer", s.transfer, "lines and arcs");
}

using Bytes = std::vector<std::uint8_t>;  // images [n x 28 x 28]

// Lines and arcs of one state of the robot's layers, asked for beside the places of the arm's.
void write_strokes(Hdf5Writer& file, const std::string& state, const TunedSlice& s, Seed seed,
                   const StackOnBody& arm, const StackOnBody& robot, Workers& workers) {
  const auto starts = static_cast<std::size_t>(s.transfer.starts);
  const auto write = [&](const char* name, const std::vector<float>& errors) {
    file.write(state + "/" + name, {errors.size() / starts, starts}, errors.data());
  };
  const auto side = [](const StackOnBody& of, int level) {
    return Side{of.stack.points(), of.stack.layer(level)};
  };
  const int lines = arm.level("lines"), arcs = arm.level("arcs");
  // Where the arm's repertoire has none just there either, and one that grew elsewhere is not worse for it.
  const Rows of_lines = places_beside(arm.elites[lines].measures, s.line_places, seed.child("line places")),
             of_arcs = places_beside(arm.elites[arcs].measures, s.arc_places, seed.child("arc places"));
  const LineErrors line = line_errors(arm.stack.model(lines).frame(), of_lines, side(arm, lines),
                                      side(robot, lines), s.transfer.starts, seed.child("lines"), workers);
  write("line", line.promise);
  write("line_from_arm", line.displacement);
  const ArcErrors arc = arc_errors(arm.stack.model(arcs), of_arcs, side(arm, arcs), side(robot, arcs),
                                   s.transfer.starts, seed.child("arcs"), workers);
  write("arc_centre", arc.promised_centre);
  write("arc_centre_from_arm", arc.centre);
  write("arc_length", arc.promised_length);
  write("arc_length_from_arm", arc.length);
}

// How good the arcs of a repertoire are, each the mean over fresh starts.
void write_arc_fitness(Hdf5Writer& file, const std::string& state, int starts, Seed seed,
                       const StackOnBody& robot, Workers& workers) {
  const int arcs = robot.level("arcs");
  const LayerModel& model = robot.stack.model(arcs);
  const Executor executor = model.executor()->fresh(starts);
  const SampledEvaluator evaluator(executor, arc_outcome(model));
  const Elites& elites = robot.elites[arcs];
  std::vector<float> fitness(static_cast<std::size_t>(elites.size()));
  workers.for_ranges(fitness.size(), 16, [&](std::size_t begin, std::size_t end) {
    evaluator.mean_fitness(elites.solution, static_cast<Eigen::Index>(begin), static_cast<Eigen::Index>(end),
                           seed, fitness.data() + begin);
  });
  file.write(state + "/arc_id", elites.id);
  file.write(state + "/arc_fitness", fitness);
}

// The digits of one state, and those of them that stand at the places of the arm's.
void write_digits(Hdf5Writer& file, const std::string& state, const Elites& digits, const Bytes& images,
                  const Rows& places, const Bytes& arm_images, const Judge& judge, Workers& workers) {
  const auto n = static_cast<std::size_t>(digits.size());
  const std::vector<std::int32_t> at = nearest_elites(places, digits).elite;
  std::vector<float> differences;
  for (std::size_t i = 0; i < at.size(); ++i)
    differences.push_back(image_difference(&arm_images[i * kImagePixels],
                                           &images[static_cast<std::size_t>(at[i]) * kImagePixels]));
  file.write(state + "/id", digits.id);
  file.write(state + "/image", {n, kImageSide, kImageSide}, images.data());
  file.write(state + "/objective", {n}, digits.objective.data());
  file.write(state + "/good", judge.judge(n, images.data(), workers).good);
  file.write(state + "/nearest", at);
  file.write(state + "/absolute", differences);
}

void run(StageRun& stage) {
  const auto s = stage.settings_as<TunedSlice>();
  const Seed seed = seed_of(stage, s);  // the same starts in all states
  // The arm's layers over the arm and over the robot, and the robot's own; the last without digits of its
  // own.
  const auto descriptor = load_descriptor(stage.input("descriptor"));
  const StackOnBody arm = read_stack(stage, "arm"), before = read_stack(stage, "before", descriptor.get()),
                    after = read_stack(stage, "after");
  Workers workers(stage.threads());
  const Judge judge(Hdf5Reader(stage.input("judge")), read_dataset(stage.input("dataset")), workers);

  Hdf5Writer file(stage.output());
  stage.write_settings(file);
  write_strokes(file, "before", s, seed, arm, before, workers);
  write_strokes(file, "all", s, seed, arm, after, workers);
  for (const auto& [state, robot] : {std::pair("before", &before), std::pair("all", &after)})
    write_arc_fitness(file, state, s.transfer.starts, seed.child("fitness"), *robot, workers);

  const Elites& digits = arm.elites.back();
  const Bytes arm_images = draw_all(arm.top(), digits, workers);
  file.write("arm/id", digits.id);
  file.write("arm/image", {static_cast<std::size_t>(digits.size()), kImageSide, kImageSide},
             arm_images.data());
  const auto write = [&](const char* state, const Elites& elites, const Bytes& images) {
    write_digits(file, state, elites, images, digits.measures, arm_images, judge, workers);
  };
  const Elites here = described(digits, before.top().evaluator(), Seed(s.seed), workers);
  write("before", here, draw_all(before.top(), here, workers));
  for (const char* state : {"top", "all"})
    write(state, read_elites(stage.input(state)),
          Hdf5Reader(stage.input(state)).read<std::uint8_t>("image").values);
  file.close();
}

}  // namespace
}  // namespace hbr::inline stages

int main(int argc, char** argv) { return hbr::stage_main(argc, argv, "What fine-tuning gains", hbr::run); }
