// Layer 4: from a genome to its place and error, and what the drawing and the network take of it.
#include "pipeline/hierarchy/digit_layer.h"

#include <benchmark/benchmark.h>

#include <ctime>

#include "models/autoencoder/autoencoder.h"
#include "tests/support/evolved_layers.h"

namespace hbr {
namespace {

constexpr Pencil kPencil{Framing::box, 1, 4};
constexpr double kSpacing = 0.012793;  // m, as in the paper's profile

// What a network costs does not hang on what it has learned.
const Autoencoder& network() {
  static const Autoencoder autoencoder([] {
    net::Network net(2, 0.1f);
    net.initialise(Seed(20), -2);
    net.refresh();
    return net;
  }());
  return autoencoder;
}

// Genomes of one to three blocks, evenly.
Batch random_batch(int head, int block) {
  Batch batch(kBatch, head + kMostArcs * block, 2);
  Rng rng(Seed(21));
  batch.genome = Rows::NullaryExpr(kBatch, batch.genome.cols(), [&] { return rng.uniform(); });
  for (int i = 0; i < kBatch; ++i) batch.length[i] = head + (1 + i % kMostArcs) * block;
  return batch;
}

// CPU seconds of one call, the least of some.
template <class Work>
double seconds(Work&& work) {
  double least = 1e9;
  for (int round = 0; round < 30; ++round) {
    const std::clock_t begin = std::clock();
    for (int i = 0; i < 3; ++i) work();
    least = std::min(least, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / 3);
  }
  return least;
}

void evaluate(benchmark::State& state, const Evaluator& evaluator, Batch& batch) {
  for (auto _ : state) {
    evaluator.evaluate(batch, 0, kBatch, Seed(22));
    benchmark::DoNotOptimize(batch.fitness.data());
  }
  state.SetItemsProcessed(state.iterations() * kBatch);
}

void digit(benchmark::State& state) {
  const EvolvedLayers& layers = evolved_layers();
  static const Elites arc_elites =
      evolved<FastParts>(ArcEvaluator(layers.points, layers.lines, kFrame, arc_controller("turn"), 10), 3,
                         kArcArchive, 500, Seed(3));
  const ArcLayer arcs(arc_elites, kFrame, arc_controller("turn"));
  const Hierarchy hierarchy(layers.points, layers.lines, arcs, kFrame, kSpacing);
  const DigitEvaluator evaluator(hierarchy, kPencil, network());
  Batch batch = random_batch(kDigitHead, kDigitBlock);
  evaluate(state, evaluator, batch);

  std::vector<std::int32_t> path;
  std::vector<float> image(kImagePixels);
  const double whole = seconds([&] { evaluator.evaluate(batch, 0, kBatch, Seed(22)); });
  const double paths = seconds([&] {
    for (int i = 0; i < kBatch; ++i) hierarchy.digit_path(batch.genome.row(i).data(), batch.length[i], path);
  });
  const double drawn = seconds([&] {
    for (int i = 0; i < kBatch; ++i)
      draw_digit(hierarchy, kPencil, batch.genome.row(i).data(), batch.length[i], image.data());
  });
  state.counters["path_share"] = paths / whole;
  state.counters["drawing_share"] = (drawn - paths) / whole;
}
BENCHMARK(digit);

void flat_digit(benchmark::State& state) {
  const PlanarArm arm(kLinks, kJointLimit);
  const FlatDigits flat(arm, kFrame, kPencil);
  const FlatDigitEvaluator evaluator(flat, network());
  Batch batch = random_batch(FlatDigits::kHead, flat.block());
  evaluate(state, evaluator, batch);

  std::vector<float> images(kBatch * kImagePixels);
  const double whole = seconds([&] { evaluator.evaluate(batch, 0, kBatch, Seed(22)); });
  const double drawn = seconds([&] {
    flat.draw_digits(kBatch, batch.genome.data(), batch.genome.cols(), batch.length.data(), images.data());
  });
  state.counters["drawing_share"] = drawn / whole;
}
BENCHMARK(flat_digit);

}  // namespace
}  // namespace hbr
