#include "stages/layers/warm_start.h"

#include "pipeline/core/check.h"
#include "pipeline/qd/containers.h"
#include "pipeline/qd/selectors.h"
#include "stages/layers/checkpoint.h"

namespace hbr::inline stages {
namespace {

// Keeps what may stand side by side in the search's container: there two elites are at least (1 - epsilon) l
// apart, so that elites which have not moved all stay.
std::unique_ptr<Repertoire> thin(const SearchTable& table, int genes, int size, DescriptorRange range) {
  const ContainerKind& kind = container_kind(table.container);
  if (kind.draws_cells)
    throw InputError(
        "container '{}' can't take over elites, it draws its cells for each search; expected another",
        kind.name);
  ContainerSettings settings = container_settings(table, range);
  settings.spacing *= 1 - settings.epsilon;
  settings.epsilon = 0;
  return kind.make(genes, size, settings, Seed(0)).repertoire;
}

}  // namespace

Elites described(const Elites& elites, const Evaluator& evaluator, Seed seed, Workers& workers) {
  const auto n = static_cast<int>(elites.size());
  Batch batch(n, static_cast<int>(elites.solution.cols()), evaluator.descriptor_size());
  batch.genome = elites.solution;
  for (int i = 0; i < n; ++i) batch.length[static_cast<std::size_t>(i)] = elites.genes(i);
  workers.for_ranges(static_cast<std::size_t>(n), 25, [&](std::size_t begin, std::size_t end) {
    evaluator.evaluate(batch, static_cast<Eigen::Index>(begin), static_cast<Eigen::Index>(end), seed);
  });
  Elites here = elites;
  here.measures = batch.descriptor;
  here.objective = batch.fitness;
  if (evaluator.stochastic())
    here.uncertainty = batch.uncertainty;
  else
    here.uncertainty.resize(0);
  std::vector<std::int32_t> behave;
  for (std::int32_t i = 0; i < n; ++i)
    if (batch.valid[static_cast<std::size_t>(i)]) behave.push_back(i);
  return in_order(here, behave);
}

void write_warm_start(const std::filesystem::path& checkpoint, const SearchTable& table, const Elites& elites,
                      std::int64_t generation, DescriptorRange range) {
  const auto size = static_cast<int>(elites.measures.cols());
  const auto repertoire = thin(table, static_cast<int>(elites.solution.cols()), size, range);
  for (Eigen::Index i = 0; i < elites.size(); ++i) repertoire->add(candidate_of(elites, i));

  const auto selector = selector_kind(table.selector).make({size, table.neighbours, range.low, range.high});
  for (Slot slot = 0; slot < repertoire->size(); ++slot) selector->learn(kNoSlot, {Admission::kNovel, slot});
  write_checkpoint(checkpoint, {generation, repertoire->store().in_slot_order(), selector->memory(), {}});
}

void evolve_on(StageRun& stage, const SearchTable& table, std::int64_t more, const Elites& elites,
               const Variation& variation, const Evaluator& evaluator, Seed seed, DescriptorRange range,
               const std::function<void(Hdf5Writer&, const Elites&)>& finish) {
  if (!can_resume(stage.checkpoint())) {
    Workers workers(stage.threads());
    write_warm_start(stage.checkpoint(), table,
                     described(elites, evaluator, seed.child("described"), workers), table.generations - more,
                     range);
  }
  evolve(stage, table, variation, evaluator, seed, range, finish);
}

}  // namespace hbr::inline stages
