// Geometric medians of 100 points like a line's or an arc's: most near the middle, some far off.
#include "pipeline/hierarchy/geometric_median.h"

#include <benchmark/benchmark.h>

#include "pipeline/core/random.h"
#include "tests/support/naive_layers.h"

namespace hbr {
namespace {

constexpr int kPoints = 100, kSets = 32;

template <int D>
std::vector<std::vector<Eigen::Matrix<double, D, 1>>> point_sets() {
  std::vector<std::vector<Eigen::Matrix<double, D, 1>>> sets(kSets);
  Rng rng(Seed(13));
  for (auto& set : sets)
    for (int i = 0; i < kPoints; ++i) {
      const float width = i % 5 == 0 ? 0.5f : 0.02f;
      auto& point = set.emplace_back();
      for (double& x : point) x = static_cast<double>(rng.uniform(0.5f - width, 0.5f + width));
    }
  return sets;
}

template <int D>
void median(benchmark::State& state) {
  std::vector<Samples<D>> sets;
  for (const auto& set : point_sets<D>()) {
    auto& samples = sets.emplace_back();
    samples.resize(kPoints);
    for (int i = 0; i < kPoints; ++i)
      for (int d = 0; d < D; ++d) samples.coordinate(d)[i] = static_cast<float>(set[i][d]);
  }
  for (auto _ : state)
    for (const auto& samples : sets) benchmark::DoNotOptimize(geometric_median<D>(samples));
  state.SetItemsProcessed(state.iterations() * kSets);
}
BENCHMARK(median<2>)->Name("median/2");
BENCHMARK(median<3>)->Name("median/3");

template <int D>
void median_naive(benchmark::State& state) {
  const auto sets = point_sets<D>();
  for (auto _ : state)
    for (const auto& set : sets) benchmark::DoNotOptimize(naive_median<D>(set));
  state.SetItemsProcessed(state.iterations() * kSets);
}
BENCHMARK(median_naive<2>)->Name("median_naive/2");
BENCHMARK(median_naive<3>)->Name("median_naive/3");

}  // namespace
}  // namespace hbr
