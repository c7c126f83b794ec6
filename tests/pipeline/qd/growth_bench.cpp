// What a repertoire costs as it grows: look-ups in the finished one, insertion into the saturated archive.
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>

#include "pipeline/core/random.h"
#include "pipeline/qd/distance_archive.h"
#include "pipeline/qd/nearest_table.h"

namespace hbr {
namespace {

constexpr int kGenes = 8, kAtOnce = 10000;

// n places on a square grid of the unit square, each moved a little.
Rows places(int n) {
  const int side = static_cast<int>(std::lround(std::sqrt(n)));
  Rng rng(Seed(1));
  Rows all(static_cast<Eigen::Index>(side) * side, 2);
  for (Eigen::Index i = 0; i < all.rows(); ++i) {
    const auto at = [&](Eigen::Index k) {
      return (static_cast<float>(k) + 0.5f + rng.uniform(-0.05f, 0.05f)) / static_cast<float>(side);
    };
    all.row(i) << at(i % side), at(i / side);
  }
  return all;
}

void grown_table(benchmark::State& state) {
  const NearestTable<2> table(places(static_cast<int>(state.range(0))), 0, 1);
  Rng rng(Seed(2));
  Eigen::VectorXf x(kAtOnce), y(kAtOnce);
  for (int i = 0; i < kAtOnce; ++i) {
    x[i] = rng.uniform();
    y[i] = rng.uniform();
  }
  std::vector<std::int32_t> found(kAtOnce);
  for (auto _ : state) {
    table.nearest(kAtOnce, {x.data(), y.data()}, found.data());
    benchmark::DoNotOptimize(found.data());
  }
  state.SetItemsProcessed(state.iterations() * kAtOnce);
}
BENCHMARK(grown_table)->Arg(5000)->Arg(50000)->Arg(500000);

// Elites whose neighbours stand as near as the spacing allows, and candidates anywhere.
void grown_archive(benchmark::State& state) {
  const Rows at = places(static_cast<int>(state.range(0)));
  const float spacing = 0.85f / std::sqrt(static_cast<float>(at.rows()));
  Elites elites;
  elites.measures = at;
  elites.solution = Rows::Constant(at.rows(), kGenes, 0.5f);
  elites.objective = Eigen::VectorXf::Zero(at.rows());
  for (Eigen::Index i = 0; i < at.rows(); ++i) {
    elites.id.push_back(i);
    elites.parent.push_back(-1);
  }
  Rng rng(Seed(3));
  std::vector<std::array<float, 3>> candidates(kAtOnce);
  for (auto& [x, y, fitness] : candidates) {
    x = rng.uniform();
    y = rng.uniform();
    fitness = rng.uniform(-1, 0.01f);  // few are better than what is there
  }
  const std::vector<float> genome(kGenes, 0.5f);
  for (auto _ : state) {
    state.PauseTiming();
    const auto archive = make_distance_archive(kGenes, 2, {spacing, 0.1f, 15, 0, 1});
    archive->restore(elites);
    std::int64_t id = elites.id.back();
    state.ResumeTiming();
    for (const auto& [x, y, fitness] : candidates) {
      const float descriptor[2] = {x, y};
      archive->add({genome.data(), kGenes, descriptor, fitness, 0, ++id});
    }
  }
  state.SetItemsProcessed(state.iterations() * kAtOnce);
  state.counters["elites"] = static_cast<double>(at.rows());
}
BENCHMARK(grown_archive)->Arg(5000)->Arg(50000)->Arg(500000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace hbr
