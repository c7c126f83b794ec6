// Layer 2: lines through the finished layer 1, whole runs.
#include "pipeline/hierarchy/layers/lines.h"

#include <benchmark/benchmark.h>

#include "tests/support/evolved_layers.h"
#include "tests/support/naive_layers.h"

namespace hbr {
namespace {

Rows random_genomes(int n, int genes) {
  Rng rng(Seed(7));
  return Rows::NullaryExpr(n, genes, [&] { return rng.uniform(); });
}

// An item is a line drawn from one start, its share of the median included.
void draw_lines(benchmark::State& state, const Evaluator& evaluator, int n) {
  Batch batch(n, 2, 2);
  batch.genome = random_genomes(n, 2);
  std::uint64_t generation = 0;
  evaluator.evaluate(batch, 0, n, Seed(8).child(generation++));  // a layer makes its table when first asked
  for (auto _ : state) {
    evaluator.evaluate(batch, 0, n, Seed(8).child(generation++));
    benchmark::DoNotOptimize(batch.descriptor.data());
  }
  state.SetItemsProcessed(state.iterations() * n * state.range(0));
}

std::unique_ptr<LayerModel> lines(std::int64_t samples) {
  const EvolvedLayers& layers = evolved_layers();
  return make_lines(lines_settings(static_cast<int>(samples)), {layers.arm, &layers.points});
}

void line(benchmark::State& state) { draw_lines(state, lines(state.range(0))->evaluator(), kBatch); }
BENCHMARK(line)->Arg(1)->Arg(10)->Arg(100);

void line_naive(benchmark::State& state) {
  const EvolvedLayers& layers = evolved_layers();
  const NaiveHierarchy hierarchy(layers.point_elites, layers.line_elites, layers.arm, kFrame);
  const NaiveLineEvaluator evaluator(hierarchy, static_cast<int>(state.range(0)));
  draw_lines(state, evaluator, 10);
}
BENCHMARK(line_naive)->Arg(1)->Arg(10)->Arg(100);

template <class Parts>
void whole_run(benchmark::State& state, const Evaluator& evaluator, std::int64_t generations) {
  Elites elites;
  for (auto _ : state) elites = evolved<Parts>(evaluator, 2, kLineArchive, generations, Seed(9));
  state.SetItemsProcessed(state.iterations() * generations * kBatch);
  state.counters["elites"] = static_cast<double>(elites.size());
}

void layer2(benchmark::State& state) {
  whole_run<FastParts>(state, lines(state.range(0))->evaluator(), 1000);
}
BENCHMARK(layer2)->Arg(1)->Arg(10)->Arg(100)->Iterations(1)->Unit(benchmark::kMillisecond);

// A few generations only: the archive is still small, which favours who scans it.
void layer2_naive(benchmark::State& state) {
  const EvolvedLayers& layers = evolved_layers();
  const NaiveHierarchy hierarchy(layers.point_elites, layers.line_elites, layers.arm, kFrame);
  whole_run<NaiveParts>(state, NaiveLineEvaluator(hierarchy, static_cast<int>(state.range(0))), 10);
}
BENCHMARK(layer2_naive)->Arg(1)->Arg(10)->Arg(100)->Iterations(1)->Unit(benchmark::kMillisecond);

template <class Parts>
void reference4d(benchmark::State& state) {
  const EvolvedLayers& layers = evolved_layers();
  const auto model = make_lines_from_start({kFrame.longest_line, "disc"}, {layers.arm, &layers.points});
  whole_run<Parts>(state, model->evaluator(), state.range(0));
}
BENCHMARK(reference4d<FastParts>)
    ->Name("reference4d")
    ->Arg(1000)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(reference4d<NaiveParts>)
    ->Name("reference4d_naive")
    ->Arg(100)
    ->Iterations(1)
    ->Repetitions(1)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace hbr
