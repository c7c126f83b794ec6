#include "stages/layers/evolve.h"

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "pipeline/core/parallel.h"
#include "pipeline/qd/search.h"
#include "stages/layers/checkpoint.h"

namespace hbr::inline stages {
namespace {

constexpr std::chrono::seconds kCheckpointEvery{20};

}  // namespace

void evolve(StageRun& stage, const SearchTable& table, const Variation& variation, const Evaluator& evaluator,
            Seed seed, DescriptorRange range, const std::function<void(Hdf5Writer&, const Elites&)>& more) {
  const int size = evaluator.descriptor_size();
  const auto [repertoire, centroids] =
      container_kind(table.container).make(variation.genes(), size, container_settings(table, range), seed);
  const auto selector = selector_kind(table.selector).make({size, table.neighbours, range.low, range.high});
  Search search(*repertoire, *selector, variation, evaluator,
                {table.generations, table.batch, table.record_every,
                 table.curiosity_credit == "published" ? Credit::kPublished : Credit::kParent},
                seed);
  if (can_resume(stage.checkpoint())) search.resume(read_checkpoint(stage.checkpoint()));

  Workers workers(stage.threads());
  auto saved = std::chrono::steady_clock::now();
  while (!search.done()) {
    search.step(workers);
    stage.progress(search.generation(), table.generations, "generations");
    if (const auto now = std::chrono::steady_clock::now(); now - saved > kCheckpointEvery) {
      write_checkpoint(stage.checkpoint(), search.state());
      saved = now;
    }
  }
  if (repertoire->size() == 0)
    throw InputError("{}: no solution had a behaviour in {} evaluations; nothing to store", stage.name(),
                     table.generations * table.batch);

  Elites elites = repertoire->store().in_id_order();
  if (!evaluator.stochastic()) elites.uncertainty.resize(0);
  if (variation.fixed_length()) elites.length.clear();
  Hdf5Writer file(stage.output());
  write_elites(file, elites, search.progress());
  if (centroids.size() > 0)
    file.write("centroids",
               {static_cast<std::size_t>(centroids.rows()), static_cast<std::size_t>(centroids.cols())},
               centroids.data());
  stage.write_settings(file);
  if (more) more(file, elites);
  file.close();
}

ContainerSettings container_settings(const SearchTable& t, DescriptorRange range) {
  return {t.spacing, t.epsilon, t.neighbours, t.grid_cells, t.cvt_cells, range.low, range.high};
}

std::unique_ptr<Variation> make_variation(const GenomeShape& genome, const SearchTable& table) {
  const Mutation mutation = {static_cast<float>(table.mutation_eta), static_cast<float>(table.mutation_rate),
                             table.mutation == "each"           ? MutatedGenes::kEach
                             : table.mutation == "at_least_one" ? MutatedGenes::kAtLeastOne
                                                                : MutatedGenes::kEvery};
  if (genome.fixed()) return std::make_unique<PolynomialMutation>(genome.genes(), mutation);
  return std::make_unique<BlockMutation>(genome.genes(0), genome.block_genes(), genome.most_blocks, mutation,
                                         static_cast<float>(genome.length_rate));
}

}  // namespace hbr::inline stages
