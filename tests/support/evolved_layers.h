// Searches at the paper's settings, and layers that they made, for the benchmarks.
#pragma once

#include <memory>
#include <numbers>

#include "models/arm/planar_arm.h"
#include "pipeline/qd/distance_archive.h"
#include "pipeline/qd/search.h"
#include "tests/support/naive_search.h"
#include "tests/support/stacks.h"

namespace hbr {

inline const std::vector<double> kLinks{.0875, .078, .072, .072, .071, .068, .068, .065};
inline constexpr double kJointLimit = std::numbers::pi / 2;
inline constexpr int kBatch = 200;

// l and epsilon of the three layers, k = 15 neighbours (paper, appendix).
inline constexpr DistanceArchiveSettings kPointArchive{0.01f, 0.1f, 15, 0, 1};
inline constexpr DistanceArchiveSettings kLineArchive{0.02f, 0.1f, 15, 0, 1};
inline constexpr DistanceArchiveSettings kArcArchive{0.05f, 0.025f, 15, 0, 1};

struct FastParts {
  static std::unique_ptr<Repertoire> archive(int genes, int size, const DistanceArchiveSettings& settings) {
    return make_distance_archive(genes, size, settings);
  }
  using Roulette = CuriositySelector;
};
struct NaiveParts {
  static std::unique_ptr<Repertoire> archive(int genes, int size, const DistanceArchiveSettings& settings) {
    return std::make_unique<NaiveArchive>(genes, size, settings);
  }
  using Roulette = NaiveRoulette;
};

inline PolynomialMutation mutation(int genes) { return {genes, {10, 0.1f}}; }

// One thread.
template <class Parts>
Elites evolved(const Evaluator& evaluator, int genes, const DistanceArchiveSettings& settings,
               std::int64_t generations, Seed seed) {
  const auto archive = Parts::archive(genes, evaluator.descriptor_size(), settings);
  typename Parts::Roulette roulette;
  const PolynomialMutation variation = mutation(genes);
  Search search(*archive, roulette, variation, evaluator, {generations, kBatch, 50}, seed);
  Workers workers(1);
  while (!search.done()) search.step(workers);
  return archive->store().in_id_order();
}

// Layers 1 and 2, finished.
struct EvolvedLayers {
  PlanarArm arm{kLinks, kJointLimit};
  PointEvaluator point_evaluator{arm, kFrame, joint_costs()[0]};
  Elites point_elites = evolved<FastParts>(point_evaluator, 8, kPointArchive, 5000, Seed(1));
  Stack points = stack_of(arm, point_elites);
  Elites line_elites = evolved<FastParts>(make_lines(lines_settings(10), {arm, &points})->evaluator(), 2,
                                          kLineArchive, 1000, Seed(2));
  Stack lines = stack_of(arm, point_elites, line_elites);
};

inline const EvolvedLayers& evolved_layers() {
  static const EvolvedLayers layers;
  return layers;
}

}  // namespace hbr
