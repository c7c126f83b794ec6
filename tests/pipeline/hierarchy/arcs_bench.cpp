// Layer 3: arcs through the finished layers 2 and 1, the flat baseline, whole runs.
#include "pipeline/hierarchy/layers/arcs.h"

#include <benchmark/benchmark.h>

#include "pipeline/hierarchy/layers/flat_arcs.h"
#include "tests/support/evolved_layers.h"
#include "tests/support/naive_layers.h"

namespace hbr {
namespace {

const ArcController& controller() { return named(arc_controllers(), "lines", "controller"); }

int arc_genes() { return static_cast<int>(controller().genes(kFrame).size()); }

std::unique_ptr<LayerModel> arcs(std::int64_t samples) {
  const EvolvedLayers& layers = evolved_layers();
  return make_arcs(arcs_settings("lines", static_cast<int>(samples)), {layers.arm, &layers.lines});
}

// An item is an arc drawn from one start: five lines, its metrics, its share of the median and of the
// fitness.
void draw_arcs(benchmark::State& state, const Evaluator& evaluator, int n, int genes, int starts) {
  Batch batch(n, genes, 3);
  Rng rng(Seed(10));
  batch.genome = Rows::NullaryExpr(n, genes, [&] { return rng.uniform(); });
  std::uint64_t generation = 0;
  evaluator.evaluate(batch, 0, n, Seed(11).child(generation++));  // a layer makes its table when first asked
  for (auto _ : state) {
    evaluator.evaluate(batch, 0, n, Seed(11).child(generation++));
    benchmark::DoNotOptimize(batch.descriptor.data());
  }
  state.SetItemsProcessed(state.iterations() * n * starts);
}

void arc(benchmark::State& state) {
  const auto starts = static_cast<int>(state.range(0));
  draw_arcs(state, arcs(starts)->evaluator(), kBatch, arc_genes(), starts);
}
BENCHMARK(arc)->Arg(1)->Arg(10)->Arg(100);

void arc_naive(benchmark::State& state) {
  const EvolvedLayers& layers = evolved_layers();
  const auto starts = static_cast<int>(state.range(0));
  const NaiveHierarchy hierarchy(layers.point_elites, layers.line_elites, layers.arm, kFrame);
  draw_arcs(state, NaiveArcEvaluator(hierarchy, controller(), starts), 5, arc_genes(), starts);
}
BENCHMARK(arc_naive)->Arg(1)->Arg(10)->Arg(100);

template <class Arm>
void flat_arc(benchmark::State& state) {
  const Arm arm(kLinks, kJointLimit);
  const FlatArcEvaluator evaluator(arm, kFrame);
  draw_arcs(state, evaluator, kBatch, evaluator.genes(), 1);
}
BENCHMARK(flat_arc<PlanarArm>)->Name("flat_arc");
BENCHMARK(flat_arc<NaiveArm>)->Name("flat_arc_naive");

template <class Parts>
void whole_run(benchmark::State& state, const Evaluator& evaluator, int genes, std::int64_t generations) {
  Elites elites;
  for (auto _ : state) elites = evolved<Parts>(evaluator, genes, kArcArchive, generations, Seed(12));
  state.SetItemsProcessed(state.iterations() * generations * kBatch);
  state.counters["elites"] = static_cast<double>(elites.size());
  state.counters["mean_fitness"] = elites.objective.mean();
}

void layer3(benchmark::State& state) {
  whole_run<FastParts>(state, arcs(state.range(0))->evaluator(), arc_genes(), 1000);
}
BENCHMARK(layer3)->Arg(1)->Arg(10)->Arg(100)->Iterations(1)->Unit(benchmark::kMillisecond);

// A few generations only: the archive is still small, which favours who scans it.
void layer3_naive(benchmark::State& state) {
  const EvolvedLayers& layers = evolved_layers();
  const NaiveHierarchy hierarchy(layers.point_elites, layers.line_elites, layers.arm, kFrame);
  whole_run<NaiveParts>(state, NaiveArcEvaluator(hierarchy, controller(), static_cast<int>(state.range(0))),
                        arc_genes(), 5);
}
BENCHMARK(layer3_naive)
    ->Arg(1)
    ->Arg(10)
    ->Arg(100)
    ->Iterations(1)
    ->Repetitions(1)
    ->Unit(benchmark::kMillisecond);

template <class Parts, class Arm>
void flat_arcs(benchmark::State& state) {
  const Arm arm(kLinks, kJointLimit);
  const FlatArcEvaluator evaluator(arm, kFrame);
  whole_run<Parts>(state, evaluator, evaluator.genes(), state.range(0));
}
BENCHMARK(flat_arcs<FastParts, PlanarArm>)
    ->Name("flat_arcs")
    ->Arg(1000)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(flat_arcs<NaiveParts, NaiveArm>)
    ->Name("flat_arcs_naive")
    ->Arg(100)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace hbr
