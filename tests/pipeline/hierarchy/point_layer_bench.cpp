// Layer 1: look-ups in the finished layer, insertion into the saturated archive, whole runs.
#include <benchmark/benchmark.h>

#include "pipeline/qd/neighbour_grid.h"
#include "tests/support/evolved_layers.h"
#include "tests/support/naive_layers.h"

namespace hbr {
namespace {

// Ends of random lines from random elites, as descriptors [n x 2].
Rows line_ends(int n) {
  const PointLayer& points = evolved_layers().points.points();
  Rng rng(Seed(3));
  Rows ends(n, 2);
  for (int i = 0; i < n; ++i) {
    const float genes[2] = {rng.uniform(), rng.uniform()};
    const auto start = static_cast<std::int32_t>(rng.below(static_cast<std::uint32_t>(points.size())));
    ends.row(i) = kFrame.point_descriptor(points.position(start) + decode_line(kFrame, genes))
                      .cast<float>()
                      .transpose();
  }
  return ends;
}

template <class Nearest>
void look_up(benchmark::State& state, int queries, Nearest&& nearest) {
  const Rows ends = line_ends(queries);
  for (auto _ : state)
    for (int i = 0; i < queries; ++i) benchmark::DoNotOptimize(nearest(ends.row(i).data()));
  state.SetItemsProcessed(state.iterations() * queries);
}

void nearest_naive(benchmark::State& state) {
  const Rows& measures = evolved_layers().point_elites.measures;
  look_up(state, 100, [&](const float* query) { return naive_nearest(measures, query); });
}
BENCHMARK(nearest_naive);

void nearest_rings(benchmark::State& state) {
  const Rows& measures = evolved_layers().point_elites.measures;
  NeighbourGrid<2> grid(0, 1, kPointArchive.spacing);
  for (Slot s = 0; s < measures.rows(); ++s) grid.insert(s, measures.row(s).data());
  look_up(state, 10000, [&](const float* query) {
    NeighbourGrid<2>::Near near;
    grid.nearest(query, 1, kNoSlot, &near);
    return near.slot;
  });
}
BENCHMARK(nearest_rings);

void nearest_table(benchmark::State& state) {
  const NearestTable<2> table(evolved_layers().point_elites.measures, -0.25f, 1.25f);
  look_up(state, 10000, [&](const float* query) { return table.nearest(query); });
}
BENCHMARK(nearest_table);

void nearest_batch(benchmark::State& state) {
  constexpr int kQueries = 10000;
  const NearestTable<2> table(evolved_layers().point_elites.measures, -0.25f, 1.25f);
  const Rows ends = line_ends(kQueries);
  const Eigen::VectorXf x = ends.col(0), y = ends.col(1);
  const int at_once = static_cast<int>(state.range(0));
  std::vector<std::int32_t> found(kQueries);
  for (auto _ : state) {
    for (int i = 0; i < kQueries; i += at_once)
      table.nearest(at_once, {x.data() + i, y.data() + i}, found.data() + i);
    benchmark::DoNotOptimize(found.data());
  }
  state.SetItemsProcessed(state.iterations() * kQueries);
}
BENCHMARK(nearest_batch)->Arg(10)->Arg(100)->Arg(1000);

// Children that the finished layer breeds, evaluated.
struct Children {
  explicit Children(int n) : batch(n, 8, 2) {
    const EvolvedLayers& layers = evolved_layers();
    const PolynomialMutation variation = mutation(8);
    Rng rng(Seed(4));
    for (int i = 0; i < n; ++i) {
      const auto parent = rng.below(static_cast<std::uint32_t>(layers.point_elites.size()));
      variation.vary(layers.point_elites.solution.row(parent).data(), 8, batch.genome.row(i).data(), rng);
    }
    layers.point_evaluator.evaluate(batch, 0, n, Seed(5));
  }
  Batch batch;
};

template <class Parts>
void insertion(benchmark::State& state) {
  const auto n = static_cast<int>(state.range(0));
  const Children children(n);
  const Batch& batch = children.batch;
  const std::int64_t first_id = evolved_layers().point_elites.id.back() + 1;
  for (auto _ : state) {
    state.PauseTiming();
    const auto archive = Parts::archive(8, 2, kPointArchive);
    archive->restore(evolved_layers().point_elites);
    state.ResumeTiming();
    for (int i = 0; i < n; ++i)
      if (batch.valid[i])
        archive->add({batch.genome.row(i).data(), 8, batch.descriptor.row(i).data(), batch.fitness[i], 0,
                      first_id + i});
  }
  state.SetItemsProcessed(state.iterations() * n);
}
BENCHMARK(insertion<FastParts>)->Name("insertion")->Arg(20000)->Unit(benchmark::kMillisecond);
BENCHMARK(insertion<NaiveParts>)->Name("insertion_naive")->Arg(500)->Unit(benchmark::kMillisecond);

// The archive's size and fitness come with the rate: to be fast is no art for who does less.
template <class Parts, class Arm>
void layer1(benchmark::State& state) {
  const Arm arm(kLinks, kJointLimit);
  const PointEvaluator evaluator(arm, kFrame, joint_costs()[0]);
  Elites elites;
  for (auto _ : state) elites = evolved<Parts>(evaluator, 8, kPointArchive, state.range(0), Seed(6));
  state.SetItemsProcessed(state.iterations() * state.range(0) * kBatch);
  state.counters["elites"] = static_cast<double>(elites.size());
  state.counters["mean_fitness"] = elites.objective.mean();
  state.counters["mean_deviation"] = (-elites.objective).cwiseSqrt().mean();  // of the joints, rad
}
BENCHMARK(layer1<FastParts, PlanarArm>)
    ->Name("layer1")
    ->Arg(200)
    ->Arg(1000)
    ->Arg(10000)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(layer1<NaiveParts, NaiveArm>)
    ->Name("layer1_naive")
    ->Arg(200)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace hbr
