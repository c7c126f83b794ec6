// Layer 4: from a genome to its place and error, and what the drawing and the network take of it.
#include "pipeline/hierarchy/layers/digits.h"

#include <benchmark/benchmark.h>

#include <ctime>

#include "models/autoencoder/autoencoder.h"
#include "pipeline/hierarchy/layers/flat_digits.h"
#include "pipeline/hierarchy/layers/image_outcome.h"
#include "tests/support/evolved_layers.h"

namespace hbr {
namespace {

const PencilSettings kPencil{"box", 1, 4};
constexpr double kSpacing = 0.012793;  // m, as in the paper's profile

// What a network costs does not hang on what it has learned.
const Autoencoder& network() {
  static const Autoencoder autoencoder([] {
    net::Network net(2, {0.1f});
    net.initialise(Seed(20), -2);
    net.refresh();
    return net;
  }());
  return autoencoder;
}

// Genomes of one to three blocks, evenly.
Batch random_batch(int head, int block) {
  Batch batch(kBatch, head + DigitDecoder::kMaxArcs * block, 2);
  Rng rng(Seed(21));
  batch.genome = Rows::NullaryExpr(kBatch, batch.genome.cols(), [&] { return rng.uniform(); });
  for (int i = 0; i < kBatch; ++i) batch.length[i] = head + (1 + i % DigitDecoder::kMaxArcs) * block;
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
  evaluator.evaluate(batch, 0, kBatch, Seed(22));  // layers make their tables when they are first asked
  for (auto _ : state) {
    evaluator.evaluate(batch, 0, kBatch, Seed(22));
    benchmark::DoNotOptimize(batch.fitness.data());
  }
  state.SetItemsProcessed(state.iterations() * kBatch);
}

void digit(benchmark::State& state) {
  const EvolvedLayers& layers = evolved_layers();
  static const Elites arc_elites =
      evolved<FastParts>(make_arcs(arcs_settings("turn", 10), {layers.arm, &layers.lines})->evaluator(), 3,
                         kArcArchive, 500, Seed(3));
  const Stack arcs = stack_of(layers.arm, layers.point_elites, layers.line_elites, arc_elites);
  const auto digits = make_digits(digits_settings(kSpacing), {layers.arm, &arcs, &network()});
  Batch batch = random_batch(DigitDecoder::kHead, DigitDecoder::kBlock);
  evaluate(state, digits->evaluator(), batch);

  Executions executions;
  std::vector<std::uint8_t> possible(kBatch);
  std::vector<float> image(kImagePixels);
  const auto execute = [&] {
    digits->executor()->execute(batch.genome, batch.length.data(), 0, kBatch, Seed(22), executions,
                                possible.data());
  };
  const double whole = seconds([&] { digits->evaluator().evaluate(batch, 0, kBatch, Seed(22)); });
  const double paths = seconds(execute);
  const double drawn = seconds([&] {
    execute();
    for (int i = 0; i < kBatch; ++i) draw_stroke(executions, i, 0, kPencil, image.data());
  });
  state.counters["path_share"] = paths / whole;
  state.counters["drawing_share"] = (drawn - paths) / whole;
}
BENCHMARK(digit);

void flat_digit(benchmark::State& state) {
  const PlanarArm arm(kLinks, kJointLimit);
  const auto flat = std::make_shared<const FlatDigits>(arm, kFrame, kPencil);
  const FlatDigitEvaluator evaluator(flat, network());
  Batch batch = random_batch(FlatDigits::kHead, flat->block());
  evaluate(state, evaluator, batch);

  std::vector<float> images(kBatch * kImagePixels);
  const double whole = seconds([&] { evaluator.evaluate(batch, 0, kBatch, Seed(22)); });
  const double drawn = seconds([&] {
    flat->draw_digits(kBatch, batch.genome.data(), batch.genome.cols(), batch.length.data(), images.data());
  });
  state.counters["drawing_share"] = drawn / whole;
}
BENCHMARK(flat_digit);

}  // namespace
}  // namespace hbr
