// The behaviour of the search and the hierarchy as one number: short searches of every layer, container and
// selector, hashed. The network is left out; a descriptor of a few sums stands in its place.
#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "pipeline/hierarchy/layers/digits.h"
#include "pipeline/hierarchy/layers/flat_arcs.h"
#include "pipeline/hierarchy/layers/flat_digits.h"
#include "pipeline/qd/cvt_archive.h"
#include "pipeline/qd/grid_archive.h"
#include "pipeline/qd/score_selectors.h"
#include "tests/support/evolved_layers.h"

namespace hbr {
namespace {

// FNV-1a, 64 bits.
class Hash {
 public:
  template <class T>
  void add(std::span<const T> values) {
    for (const std::byte byte : std::as_bytes(values)) {
      value_ ^= std::to_integer<std::uint64_t>(byte);
      value_ *= 0x100000001b3;
    }
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325;
};

// The mean of the ink's columns, in [0, 1], and how much of a row has ink; the error is the ink's share.
class SumsDescriptor final : public Descriptor {
 public:
  const Eigen::VectorXf& lower() const override { return lower_; }
  const Eigen::VectorXf& upper() const override { return upper_; }
  void describe(Eigen::Index n, const float* images, float* position, float* error) const override {
    for (Eigen::Index i = 0; i < n; ++i) {
      float ink = 0, column = 0, row = 0;
      for (int y = 0; y < kImageSide; ++y)
        for (int x = 0; x < kImageSide; ++x) {
          const float pixel = images[i * kImagePixels + y * kImageSide + x];
          ink += pixel;
          column += pixel * static_cast<float>(x);
          row += pixel * static_cast<float>(y * y);
        }
      position[2 * i] = column / (ink + 1) / kImageSide;
      position[2 * i + 1] = row / (ink + 1) / (kImageSide * kImageSide);
      error[i] = ink / kImagePixels;
    }
  }

 private:
  Eigen::VectorXf lower_ = Eigen::Vector2f(0, 0), upper_ = Eigen::Vector2f(1, 1);
};

constexpr DistanceArchiveSettings kDigitArchive{0.1f, 0.1f, 15, 0, 1};

class Signature {
 public:
  // Every search has another seed.
  Elites run(Repertoire& repertoire, Selector& selector, const Variation& variation,
             const Evaluator& evaluator, std::int64_t generations, Credit credit = Credit::kParent) {
    Search search(repertoire, selector, variation, evaluator, {generations, 100, 10, credit},
                  Seed(2018).child(searches_++));
    while (!search.done()) search.step(workers_);
    const Elites elites = repertoire.store().in_id_order();
    add(elites.solution);
    add(elites.measures);
    add(elites.objective);
    add(elites.uncertainty);
    hash_.add(std::span(elites.id));
    hash_.add(std::span(elites.parent));
    hash_.add(std::span(elites.length));
    for (const ProgressRow& row : search.progress()) {
      hash_.add(std::span(&row.best, 1));
      hash_.add(std::span(&row.mean, 1));
    }
    return elites;
  }
  // By the paper's parts.
  Elites run(const DistanceArchiveSettings& settings, const Variation& variation, const Evaluator& evaluator,
             std::int64_t generations) {
    CuriositySelector curiosity;
    return run(*make_distance_archive(variation.genes(), evaluator.descriptor_size(), settings), curiosity,
               variation, evaluator, generations);
  }
  std::uint64_t value() const { return hash_.value(); }

 private:
  template <class Matrix>
  void add(const Matrix& matrix) {
    hash_.add(std::span(matrix.data(), static_cast<std::size_t>(matrix.size())));
  }
  Hash hash_;
  std::uint64_t searches_ = 0;
  Workers workers_{2};
};

void other_searches(Signature& signature, const Evaluator& points) {
  const PolynomialMutation variation = mutation(8);
  const auto scores = [] { return make_local_scores(2, 15, 0, 1); };
  std::vector<std::unique_ptr<Selector>> selectors;
  selectors.push_back(std::make_unique<UniformSelector>());
  selectors.push_back(std::make_unique<FitnessSelector>());
  selectors.push_back(std::make_unique<NoveltySelector>(scores()));
  selectors.push_back(std::make_unique<NslcSelector>(scores()));
  for (const auto& selector : selectors)
    signature.run(*make_distance_archive(8, 2, kPointArchive), *selector, variation, points, 20);
  CuriositySelector published, grid_curiosity, cvt_curiosity, local_curiosity;
  signature.run(*make_distance_archive(8, 2, kPointArchive), published, variation, points, 40,
                Credit::kPublished);
  DistanceArchiveSettings local = kPointArchive;
  local.contest = Contest::kFitness;
  signature.run(*make_distance_archive(8, 2, local), local_curiosity, variation, points, 40);
  GridArchive grid(8, GridCells{2, 64, 0, 1});
  signature.run(grid, grid_curiosity, variation, points, 40);
  signature.run(*make_cvt_archive(8, cvt_centroids(500, 2, 0, 1, Seed(3)), 0, 1), cvt_curiosity, variation,
                points, 40);
}

// A search of a layer with the paper's mutation rates.
Elites run(Signature& signature, const DistanceArchiveSettings& archive, const LayerModel& model,
           std::int64_t generations) {
  const GenomeShape shape = model.genome();
  if (shape.fixed()) return signature.run(archive, mutation(shape.genes()), model.evaluator(), generations);
  const BlockMutation blocks(shape.genes(0), shape.block_genes(), shape.most_blocks, {10, 0.1f},
                             static_cast<float>(shape.length_rate));
  return signature.run(archive, blocks, model.evaluator(), generations);
}

void arcs(Signature& signature, const PlanarArm& arm, const Stack& lines) {
  for (const ArcReadingSettings& reading :
       {ArcReadingSettings{"circle", "mean"}, ArcReadingSettings{"centroid", "pooled"}}) {
    for (const int samples : {1, 10})
      run(signature, kArcArchive, *make_arcs(arcs_settings("lines", samples, reading), {arm, &lines}), 30);
    for (const char* start : {"straight", "first", "random"})
      run(signature, kArcArchive,
          *make_flat_arcs({reading, kFrame.half_side, kFrame.longest_line, start}, {arm}), 50);
  }
}

void digits(Signature& signature, const PlanarArm& arm, const Stack& arcs) {
  const SumsDescriptor sums;
  for (const char* out_of_range : {"radius", "axes", "reject"})
    for (const double spacing : {0.0, 0.01})
      run(signature, kDigitArchive, *make_digits(digits_settings(spacing, out_of_range), {arm, &arcs, &sums}),
          40);
  for (const auto& [pen, start] : {std::pair{"straight", "first"}, std::pair{"joints", "straight_arm"}})
    run(signature, kDigitArchive,
        *make_flat_digits({kFrame.half_side, pen, start, 0.05, {"box", 1, 4}}, {arm, nullptr, &sums}), 40);
}

std::uint64_t signature() {
  Signature signature;
  const PlanarArm arm(kLinks, kJointLimit);
  const auto points = make_points(points_settings(), {arm});
  const Elites point_elites = run(signature, kPointArchive, *points, 600);
  run(signature, kPointArchive, *make_points(points_settings("few_joints"), {arm}), 100);
  other_searches(signature, points->evaluator());

  const Stack one = stack_of(arm, point_elites);
  for (const char* range : {"disc", "square"})
    for (const int samples : {1, 100})
      run(signature, kLineArchive, *make_lines(lines_settings(samples, range), {arm, &one}), 40);
  const Elites line_elites = run(signature, kLineArchive, *make_lines(lines_settings(10), {arm, &one}), 400);
  run(signature, kLineArchive, *make_lines_from_start({kFrame.longest_line, "disc"}, {arm, &one}), 50);

  const Stack two = stack_of(arm, point_elites, line_elites);
  arcs(signature, arm, two);
  const Elites arc_elites =
      run(signature, kArcArchive, *make_arcs(arcs_settings("turn", 10), {arm, &two}), 200);
  digits(signature, arm, stack_of(arm, point_elites, line_elites, arc_elites));
  return signature.value();
}

}  // namespace
}  // namespace hbr

int main() { fmt::print("{:016x}\n", hbr::signature()); }
