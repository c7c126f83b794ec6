#include "stages/transplant.h"

#include <algorithm>
#include <numeric>

#include "pipeline/artifact/temporary.h"
#include "pipeline/core/check.h"
#include "pipeline/qd/distance_archive.h"
#include "pipeline/qd/grid_archive.h"

namespace hbr {
namespace {

// Keeps what may stand side by side in the search's container: there two elites are at least (1 - epsilon) l
// apart, so that elites which have not moved all stay.
std::unique_ptr<Repertoire> sieve(const SearchTable& t, int genes, int size, DescriptorRange range) {
  if (t.container == "cvt")
    throw InputError("container 'cvt' can't take over elites; expected distance, local_competition or grid");
  if (t.container == "grid")
    return std::make_unique<GridArchive>(genes, GridCells{size, t.grid_cells, range.low, range.high});
  return make_distance_archive(
      genes, size,
      {static_cast<float>((1 - t.epsilon) * t.spacing), 0, t.neighbours, range.low, range.high,
       t.container == "local_competition" ? Contest::kFitness : Contest::kDominance});
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

void write_transplant(const std::filesystem::path& checkpoint, const SearchTable& table, const Elites& elites,
                      std::int64_t generation, DescriptorRange range) {
  const auto repertoire =
      sieve(table, static_cast<int>(elites.solution.cols()), static_cast<int>(elites.measures.cols()), range);
  for (Eigen::Index i = 0; i < elites.size(); ++i) repertoire->add(candidate_of(elites, i));

  const Elites kept = repertoire->store().in_slot_order();
  std::vector<std::int32_t> slots(static_cast<std::size_t>(kept.size()));
  std::iota(slots.begin(), slots.end(), 0);
  std::ranges::sort(slots, {}, [&](std::int32_t slot) { return kept.id[static_cast<std::size_t>(slot)]; });
  const std::vector<std::int64_t> curiosity(table.selector == "curiosity" ? slots.size() : 0, 0);

  const std::filesystem::path unfinished = temporary_beside(checkpoint);
  Hdf5Writer file(unfinished);
  write_elites(file, in_order(kept, slots), {});
  file.write("slot", slots);
  file.write("selector", curiosity);
  file.write("generation", std::vector<std::int64_t>{generation});
  file.close();
  std::filesystem::rename(unfinished, checkpoint);
}

void evolve_on(StageRun& stage, const SearchTable& table, std::int64_t more, const Elites& elites,
               const Variation& variation, const Evaluator& evaluator, Seed seed, DescriptorRange range,
               const std::function<void(Hdf5Writer&, const Elites&)>& finish) {
  if (!std::filesystem::exists(stage.checkpoint())) {
    Workers workers(stage.threads());
    write_transplant(stage.checkpoint(), table,
                     described(elites, evaluator, seed.child("described"), workers), table.generations - more,
                     range);
  }
  evolve(stage, table, variation, evaluator, seed, range, finish);
}

}  // namespace hbr
