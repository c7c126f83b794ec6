// What fine-tuning gains (paper, section 5.2, as an outlook): the arm's lines, arcs and digits as another
// robot draws them before and after its layers evolved on, asked for at the same places. With the arm in the
// robot's place: what more generations gain by themselves.
#include <algorithm>
#include <cstdlib>

#include "models/judge/judge.h"
#include "pipeline/core/parallel.h"
#include "stages/descriptors.h"
#include "stages/layer_errors.h"
#include "stages/robot_tasks.h"
#include "stages/transplant.h"
#include "stages/tuning.h"

namespace hbr {
namespace {

struct TunedSlice : DigitsSlice, Drawer {
  double line_places = 0, arc_places = 0;
  ArcReadingTable reading;
  TransferTable transfer;
};
template <class Fields>
void describe(Fields& f, TunedSlice& s) {
  describe_digits(f, s);
  describe_drawer(f, s);
  f.number("line_places", s.line_places, Range{0, 1}, "how far from the arm's lines lines are asked for");
  f.number("arc_places", s.arc_places, Range{0, 1}, "how far from the arm's arcs arcs are asked for");
  f.table("reading", s.reading, "of an arc's descriptor");
  f.table("transfer", s.transfer, "lines and arcs");
}

using Bytes = std::vector<std::uint8_t>;  // images [n x 28 x 28]

Bytes draw_all(const Hierarchy& hierarchy, const Pencil& pencil, const Elites& digits, Workers& workers) {
  const auto n = static_cast<std::size_t>(digits.size());
  Bytes images(n * kImagePixels);
  workers.for_ranges(n, 16, [&](std::size_t begin, std::size_t end) {
    Eigen::VectorXf image(kImagePixels);
    for (std::size_t i = begin; i < end; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      draw_digit(hierarchy, pencil, digits.solution.row(row).data(), digits.genes(row), image.data());
      image_to_bytes(image.data(), &images[i * kImagePixels]);
    }
  });
  return images;
}

// For each place in the latent space the digit of `digits` that is nearest.
std::vector<std::int32_t> nearest(const Rows& places, const Elites& digits) {
  std::vector<std::int32_t> found;
  for (Eigen::Index i = 0; i < places.rows(); ++i) {
    Eigen::Index best = 0;
    (digits.measures.rowwise() - places.row(i)).rowwise().squaredNorm().minCoeff(&best);
    found.push_back(static_cast<std::int32_t>(best));
  }
  return found;
}

// Mean absolute difference per pixel between image i and the one of `others` that stands for it.
std::vector<float> differences(const Bytes& images, const Bytes& others,
                               const std::vector<std::int32_t>& of) {
  std::vector<float> result;
  for (std::size_t i = 0; i < of.size(); ++i) {
    int sum = 0;
    for (std::size_t p = 0; p < kImagePixels; ++p)
      sum +=
          std::abs(images[i * kImagePixels + p] - others[static_cast<std::size_t>(of[i]) * kImagePixels + p]);
    result.push_back(static_cast<float>(sum) / (255.0f * kImagePixels));
  }
  return result;
}

// The places of the arm's elites, each coordinate moved by up to `by`: where the arm's repertoire has none
// just there either, and one that grew elsewhere is not worse for it.
Rows beside(const Elites& elites, double by, Seed seed) {
  Rng rng(seed);
  const auto most = static_cast<float>(by);
  Rows places = elites.measures;
  for (float& place : places.reshaped<Eigen::RowMajor>())
    place = std::clamp(place + rng.uniform(-most, most), 0.0f, 1.0f);
  return places;
}

// Lines and arcs of one state of the robot's layers, asked for beside the places of the arm's.
void write_strokes(Hdf5Writer& file, const std::string& state, const StageRun& stage, const TunedSlice& s,
                   const PointLayer& arm, const PointLayer& robot, const Strokes& original,
                   const Strokes& other, Workers& workers) {
  const Seed seed = Seed(s.seed).child(stage.stage()).child(s.replication);  // the same starts in all states
  const Frame frame = make_frame(s);
  const auto starts = static_cast<std::size_t>(s.transfer.starts);
  const auto write = [&](const char* name, const std::vector<float>& errors) {
    file.write(state + "/" + name, {errors.size() / starts, starts}, errors.data());
  };
  const Rows of_lines = beside(read_elites(stage.input("layer2")), s.line_places, seed.child("line places")),
             of_arcs = beside(read_elites(stage.input("layer3")), s.arc_places, seed.child("arc places"));
  const LineErrors line = line_errors(arm, robot, line_tasks(frame, of_lines, original.lines, other.lines),
                                      s.transfer.starts, seed.child("lines"), workers);
  write("line", line.promise);
  write("line_from_arm", line.displacement);
  const ArcErrors arc =
      arc_errors(arm, robot, arc_tasks(frame, of_arcs, original, other), make_reading(s.reading).centre,
                 s.transfer.starts, seed.child("arcs"), workers);
  write("arc_centre", arc.promised_centre);
  write("arc_centre_from_arm", arc.centre);
  write("arc_length", arc.promised_length);
  write("arc_length_from_arm", arc.length);
}

// How good the arcs of a repertoire are, each the mean over fresh starts.
void write_arc_fitness(Hdf5Writer& file, const std::string& state, const StageRun& stage, const TunedSlice& s,
                       const PointLayer& robot, const LineLayer& lines, const Elites& arcs,
                       Workers& workers) {
  const ArcEvaluator evaluator(robot, lines, make_frame(s), arc_controller(s.controller), s.transfer.starts,
                               make_reading(s.reading));
  const Seed seed = Seed(s.seed).child(stage.stage()).child(s.replication).child("fitness");
  std::vector<float> fitness(static_cast<std::size_t>(arcs.size()));
  workers.for_ranges(fitness.size(), 16, [&](std::size_t begin, std::size_t end) {
    evaluator.mean_fitness(arcs.solution, static_cast<Eigen::Index>(begin), static_cast<Eigen::Index>(end),
                           seed, fitness.data() + begin);
  });
  file.write(state + "/arc_fitness", fitness);
}

// The digits of one state, and those of them that stand at the places of the arm's.
void write_digits(Hdf5Writer& file, const std::string& state, const Elites& digits, const Bytes& images,
                  const Rows& places, const Bytes& arm_images, const Judge& judge, Workers& workers) {
  const auto n = static_cast<std::size_t>(digits.size());
  const std::vector<std::int32_t> at = nearest(places, digits);
  file.write(state + "/image", {n, kImageSide, kImageSide}, images.data());
  file.write(state + "/objective", {n}, digits.objective.data());
  file.write(state + "/good", judge.judge(n, images.data(), workers).good);
  file.write(state + "/nearest", at);
  file.write(state + "/absolute", differences(arm_images, images, at));
}

void run(StageRun& stage) {
  const auto s = stage.settings_as<TunedSlice>();
  const Frame frame = make_frame(s);
  const PlanarArm arm = make_arm(s.arm);
  const auto robot = make_drawer(stage, s, s.arm);
  const PointLayer arm_points = read_points(stage, "layer1", arm, frame),
                   points = read_points(stage, "points", *robot, frame);
  const LineLayer lines = read_lines(stage, "layer2", frame), tuned_lines = read_lines(stage, "lines", frame);
  const ArcLayer arcs = read_arcs(stage, "layer3", frame, s.controller),
                 tuned_arcs = read_arcs(stage, "arcs", frame, s.controller);
  const auto over = [&](const PointLayer& below) {
    return Hierarchy(below, lines, arcs, frame, s.line_spacing, out_of_range(s.out_of_range));
  };
  const Hierarchy by_arm = over(arm_points), by_robot = over(points);
  const auto descriptor = load_descriptor(stage.input("descriptor"));
  const Pencil pencil = make_pencil(s.pencil);
  Workers workers(stage.threads());
  const Judge judge(Hdf5Reader(stage.input("judge")), read_dataset(stage.input("dataset")), workers);

  Hdf5Writer file(stage.output());
  stage.write_settings(file);
  const Strokes of_arm{lines, arcs};
  write_strokes(file, "before", stage, s, arm_points, points, of_arm, of_arm, workers);
  write_strokes(file, "all", stage, s, arm_points, points, of_arm, {tuned_lines, tuned_arcs}, workers);
  write_arc_fitness(file, "before", stage, s, points, lines, read_elites(stage.input("layer3")), workers);
  write_arc_fitness(file, "all", stage, s, points, tuned_lines, read_elites(stage.input("arcs")), workers);

  const Elites digits = read_elites(stage.input("layer4"));
  const Bytes arm_images = draw_all(by_arm, pencil, digits, workers);
  file.write("arm/image", {static_cast<std::size_t>(digits.size()), kImageSide, kImageSide},
             arm_images.data());
  const auto write = [&](const char* state, const Elites& elites, const Bytes& images) {
    write_digits(file, state, elites, images, digits.measures, arm_images, judge, workers);
  };
  const Elites before =
      described(digits, DigitEvaluator(by_robot, pencil, *descriptor), Seed(s.seed), workers);
  write("before", before, draw_all(by_robot, pencil, before, workers));
  for (const char* state : {"top", "all"})
    write(state, read_elites(stage.input(state)),
          Hdf5Reader(stage.input(state)).read<std::uint8_t>("image").values);
  file.close();
}

}  // namespace
}  // namespace hbr

int main(int argc, char** argv) { return hbr::stage_main(argc, argv, "What fine-tuning gains", hbr::run); }
