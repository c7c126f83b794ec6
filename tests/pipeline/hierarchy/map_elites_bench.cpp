// The genes of layer 1 in a grid of 100 x 100 cells, parents drawn evenly: this project's search beside the
// smallest MAP-Elites (Mouret and Clune 2015) that does the same work, one child after the other in one loop.
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "pipeline/qd/grid_archive.h"
#include "tests/support/evolved_layers.h"

namespace hbr {
namespace {

constexpr int kGenes = 8, kCells = 100, kGenerations = 1000;

void tell(benchmark::State& state, std::size_t elites, double mean_fitness) {
  state.SetItemsProcessed(state.iterations() * kGenerations * kBatch);
  state.counters["elites"] = static_cast<double>(elites);
  state.counters["mean_fitness"] = mean_fitness;
}

void grid(benchmark::State& state) {
  const PlanarArm arm(kLinks, kJointLimit);
  const PointEvaluator evaluator(arm, kFrame, joint_costs()[0]);
  const PolynomialMutation variation = mutation(kGenes);
  std::size_t elites = 0;
  double mean_fitness = 0;
  for (auto _ : state) {
    GridArchive archive(kGenes, {2, kCells, 0, 1});
    UniformSelector selector;
    Search search(archive, selector, variation, evaluator, {kGenerations, kBatch, kGenerations}, Seed(1));
    Workers workers(1);
    while (!search.done()) search.step(workers);
    elites = static_cast<std::size_t>(archive.store().size());
    mean_fitness = archive.store().in_id_order().objective.mean();
  }
  tell(state, elites, mean_fitness);
}
BENCHMARK(grid)->Iterations(1)->Unit(benchmark::kMillisecond);

void map_elites(benchmark::State& state) {
  using Genome = std::array<float, kGenes>;
  const PolynomialMutation variation = mutation(kGenes);
  const auto half_side = static_cast<float>(kFrame.half_side);
  std::size_t elites = 0;
  double mean_fitness = 0;
  for (auto _ : state) {
    std::vector<Genome> genome(kCells * kCells);
    std::vector<float> fitness(genome.size(), -std::numeric_limits<float>::infinity());
    std::vector<std::size_t> filled;
    Rng rng(Seed(1));
    for (int child = 0; child < kGenerations * kBatch; ++child) {
      Genome genes;
      if (child < kBatch) {
        for (float& g : genes) g = rng.uniform();
      } else {
        const Genome& parent = genome[filled[rng.below(static_cast<std::uint32_t>(filled.size()))]];
        variation.vary(parent.data(), kGenes, genes.data(), rng);
        if (genes == parent) continue;
      }
      float angle = 0, x = 0, y = 0, sum = 0, squares = 0;
      for (int j = 0; j < kGenes; ++j) {
        const float joint = (2 * genes[static_cast<std::size_t>(j)] - 1) * static_cast<float>(kJointLimit);
        angle += joint;
        x += static_cast<float>(kLinks[static_cast<std::size_t>(j)]) * std::cos(angle);
        y += static_cast<float>(kLinks[static_cast<std::size_t>(j)]) * std::sin(angle);
        sum += joint;
        squares += joint * joint;
      }
      if (std::abs(x) > half_side || std::abs(y) > half_side) continue;
      const auto cell_of = [&](float place) {
        return std::min(static_cast<std::size_t>((place / half_side + 1) / 2 * kCells),
                        std::size_t{kCells - 1});
      };
      const std::size_t cell = cell_of(y) * kCells + cell_of(x);
      const float fit = -(squares - sum * sum / kGenes) / kGenes;
      if (fitness[cell] == -std::numeric_limits<float>::infinity()) filled.push_back(cell);
      if (fit <= fitness[cell]) continue;
      fitness[cell] = fit;
      genome[cell] = genes;
    }
    elites = filled.size();
    mean_fitness = 0;
    for (const std::size_t cell : filled) mean_fitness += fitness[cell] / static_cast<double>(elites);
  }
  tell(state, elites, mean_fitness);
}
BENCHMARK(map_elites)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace hbr
