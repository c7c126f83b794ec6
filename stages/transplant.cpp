#include "stages/transplant.h"

#include <algorithm>
#include <numeric>

#include "pipeline/core/check.h"
#include "pipeline/qd/distance_archive.h"
#include "pipeline/qd/grid_archive.h"

namespace hbr {
namespace {

std::unique_ptr<Repertoire> empty_repertoire(const SearchTable& t, int genes, int size,
                                             DescriptorRange range) {
  if (t.container == "cvt")
    throw InputError("container 'cvt' can't take over elites; expected distance, local_competition or grid");
  if (t.container == "grid")
    return std::make_unique<GridArchive>(genes, GridCells{size, t.grid_cells, range.low, range.high});
  return make_distance_archive(
      genes, size,
      {static_cast<float>(t.spacing), static_cast<float>(t.epsilon), t.neighbours, range.low, range.high,
       t.container == "local_competition" ? Contest::kFitness : Contest::kDominance});
}

}  // namespace

void write_transplant(const std::filesystem::path& checkpoint, const SearchTable& table, const Elites& elites,
                      std::int64_t generation, DescriptorRange range) {
  const auto repertoire = empty_repertoire(table, static_cast<int>(elites.solution.cols()),
                                           static_cast<int>(elites.measures.cols()), range);
  for (Eigen::Index i = 0; i < elites.size(); ++i) repertoire->add(candidate_of(elites, i));

  const Elites kept = repertoire->store().in_slot_order();
  std::vector<std::int32_t> slots(static_cast<std::size_t>(kept.size()));
  std::iota(slots.begin(), slots.end(), 0);
  std::ranges::sort(slots, {}, [&](std::int32_t slot) { return kept.id[static_cast<std::size_t>(slot)]; });
  // Nobody has had a child here yet: a curiosity of 0.
  const std::vector<std::int64_t> curiosity(table.selector == "curiosity" ? slots.size() : 0, 0);

  const std::filesystem::path unfinished = checkpoint.string() + ".new";
  Hdf5Writer file(unfinished);
  write_elites(file, in_order(kept, slots), {});
  file.write("slot", slots);
  file.write("selector", curiosity);
  file.write("generation", std::vector<std::int64_t>{generation});
  file.close();
  std::filesystem::rename(unfinished, checkpoint);
}

}  // namespace hbr
