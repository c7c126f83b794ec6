// The behaviour of the search and the hierarchy as one number: short searches of every layer, container and
// selector, hashed. The network is left out; a descriptor of a few sums stands in its place.
#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "pipeline/hierarchy/digit_layer.h"
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

std::uint64_t signature() {
  Signature signature;
  const PlanarArm arm(kLinks, kJointLimit);
  const PointEvaluator variance(arm, kFrame, joint_variance, 0), few(arm, kFrame, few_joints, 0);
  const Elites point_elites = signature.run(kPointArchive, mutation(8), variance, 600);
  signature.run(kPointArchive, mutation(8), few, 100);
  other_searches(signature, variance);

  const PointLayer points(point_elites, arm, kFrame);
  Frame square = kFrame;
  square.line_range = LineRange::kSquare;
  for (const Frame& frame : {kFrame, square})
    for (const int samples : {1, 100})
      signature.run(kLineArchive, mutation(2), LineEvaluator(points, frame, samples), 40);
  const Elites line_elites = signature.run(kLineArchive, mutation(2), LineEvaluator(points, kFrame, 10), 400);
  signature.run(kLineArchive, mutation(2), LineFromStartEvaluator(points, kFrame), 50);

  const LineLayer lines(line_elites, kFrame);
  const ArcController five_lines = arc_controller("lines"), turn = arc_controller("turn");
  for (const ArcReading reading : {ArcReading{}, ArcReading{ArcCentre::kCentroid, JointTerm::kPooled}}) {
    for (const int samples : {1, 10})
      signature.run(kArcArchive, mutation(five_lines.genes),
                    ArcEvaluator(points, lines, kFrame, five_lines, samples, reading), 30);
    for (const FlatStart start : {FlatStart::kStraight, FlatStart::kFirst, FlatStart::kRandom}) {
      const FlatArcEvaluator flat(arm, kFrame, start, reading);
      signature.run(kArcArchive, mutation(flat.genes()), flat, 50);
    }
  }
  const Elites arc_elites =
      signature.run(kArcArchive, mutation(turn.genes), ArcEvaluator(points, lines, kFrame, turn, 10), 200);

  const ArcLayer arcs(arc_elites, kFrame, turn);
  const SumsDescriptor sums;
  const Pencil pencil{Framing::box, 1, 4};
  const BlockMutation triplets(kDigitHead, kDigitBlock, kMostArcs, 10, 0.1f, 0.05f);
  for (const OutOfRange out_of_range : {OutOfRange::kRadius, OutOfRange::kAxes, OutOfRange::kReject})
    for (const double spacing : {0.0, 0.01}) {
      const Hierarchy hierarchy(points, lines, arcs, kFrame, spacing, out_of_range);
      signature.run(kDigitArchive, triplets, DigitEvaluator(hierarchy, pencil, sums), 40);
    }
  for (const FlatDigitReading reading :
       {FlatDigitReading{}, FlatDigitReading{FlatPen::kJoints, FlatDigitStart::kStraightArm}}) {
    const FlatDigits flat(arm, kFrame, pencil, reading);
    const BlockMutation sets(FlatDigits::kHead, flat.block(), kMostArcs, 10, 0.1f, 0.05f);
    signature.run(kDigitArchive, sets, FlatDigitEvaluator(flat, sums), 40);
  }
  return signature.value();
}

}  // namespace
}  // namespace hbr

int main() { fmt::print("{:016x}\n", hbr::signature()); }
