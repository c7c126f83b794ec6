// Fine-tuning (paper, section 5.2, as an outlook): the evolution of layer 4 goes on over another robot, from
// the arm's digits, and what that gains.
#include <algorithm>
#include <cstdlib>

#include "models/judge/judge.h"
#include "models/simbody/plane_file.h"
#include "models/simbody/robot_on_plane.h"
#include "pipeline/core/parallel.h"
#include "stages/descriptors.h"
#include "stages/digit_images.h"
#include "stages/robot_tasks.h"
#include "stages/transplant.h"

namespace hbr {
namespace {

struct TunedSlice : DigitsEvolution {
  TuningTable tuning;
  RobotSettings robot;
};
template <class Fields>
void describe(Fields& f, TunedSlice& s) {
  describe(f, static_cast<DigitsEvolution&>(s));
  f.table("tuning", s.tuning, "how long");
  f.table("robot", s.robot, "the robot");
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

// The same genomes, described as they are drawn here.
Elites described(const Elites& digits, const DigitEvaluator& evaluator, Workers& workers) {
  const auto n = static_cast<int>(digits.size());
  Batch batch(n, static_cast<int>(digits.solution.cols()), evaluator.descriptor_size());
  batch.genome = digits.solution;
  for (int i = 0; i < n; ++i) batch.length[static_cast<std::size_t>(i)] = digits.genes(i);
  workers.for_ranges(static_cast<std::size_t>(n), 25, [&](std::size_t begin, std::size_t end) {
    evaluator.evaluate(batch, static_cast<Eigen::Index>(begin), static_cast<Eigen::Index>(end), Seed(0));
  });
  Elites here = digits;
  here.length = batch.length;
  here.measures = batch.descriptor;
  here.objective = batch.fitness;
  return here;
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

void write_images(Hdf5Writer& file, const std::string& name, const Bytes& images) {
  file.write(name, {images.size() / kImagePixels, kImageSide, kImageSide}, images.data());
}

void run(StageRun& stage) {
  const auto s = stage.settings_as<TunedSlice>();
  const Frame frame = make_frame(s);
  const PlanarArm arm = make_arm(s.arm);
  const RobotOnPlane robot = make_robot(s.robot, load_plane(stage.input("plane")));
  const PointLayer arm_points = read_points(stage, "layer1", arm, frame),
                   robot_points = read_points(stage, "robot_layer1", robot, frame);
  const LineLayer lines = read_lines(stage, "layer2", frame);
  const ArcLayer arcs = read_arcs(stage, "layer3", frame, s.controller);
  const OutOfRange beyond = out_of_range(s.out_of_range);
  const Hierarchy by_arm(arm_points, lines, arcs, frame, s.line_spacing, beyond),
      by_robot(robot_points, lines, arcs, frame, s.line_spacing, beyond);
  const auto descriptor = load_descriptor(stage.input("descriptor"));
  const DescriptorRange range{descriptor->lower().minCoeff(), descriptor->upper().maxCoeff()};
  const Pencil pencil = make_pencil(s.pencil);
  const DigitEvaluator digits(by_robot, pencil, *descriptor);

  Workers workers(stage.threads());
  const Elites of_arm = read_elites(stage.input("layer4"));
  const Elites before = described(of_arm, digits, workers);
  const std::int64_t begun = s.search.generations - s.tuning.generations;
  if (!std::filesystem::exists(stage.checkpoint()))
    write_transplant(stage.checkpoint(), s.search, before, begun, range);

  const BlockMutation variation(kDigitHead, kDigitBlock, kMostArcs, static_cast<float>(s.search.mutation_eta),
                                static_cast<float>(s.search.mutation_rate),
                                static_cast<float>(s.length_rate));
  evolve(stage, s.search, variation, digits, Seed(s.seed).child(stage.stage()).child(s.replication), range,
         [&](Hdf5Writer& file, const Elites& after) {
           const Bytes arm_images = draw_all(by_arm, pencil, of_arm, workers),
                       images_before = draw_all(by_robot, pencil, of_arm, workers),
                       images_after = draw_all(by_robot, pencil, after, workers);
           const std::vector<std::int32_t> place_before = nearest(of_arm.measures, before),
                                           place_after = nearest(of_arm.measures, after);
           write_images(file, "arm/image", arm_images);
           file.write("arm/objective", {before.id.size()}, of_arm.objective.data());
           write_images(file, "before/image", images_before);
           write_images(file, "after/image", images_after);
           file.write("before/objective", {before.id.size()}, before.objective.data());
           file.write("before/nearest", place_before);
           file.write("after/nearest", place_after);
           file.write("before/absolute", differences(arm_images, images_before, place_before));
           file.write("after/absolute", differences(arm_images, images_after, place_after));

           const Dataset dataset = read_dataset(stage.input("dataset"));
           const Judge judge(Hdf5Reader(stage.input("judge")), dataset, workers);
           for (const auto& [name, images] :
                {std::pair{"arm", &arm_images}, {"before", &images_before}, {"after", &images_after}})
             file.write(std::string(name) + "/good",
                        judge.judge(images->size() / kImagePixels, images->data(), workers).good);
         });
}

}  // namespace
}  // namespace hbr

int main(int argc, char** argv) {
  return hbr::stage_main(argc, argv, "Layer 4 goes on over another robot", hbr::run);
}
