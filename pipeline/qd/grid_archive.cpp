#include "pipeline/qd/grid_archive.h"

#include <algorithm>

#include "pipeline/core/check.h"

namespace hbr {

GridArchive::GridArchive(int genes, int descriptor_size, int cells, float low, float high)
    : Repertoire(genes, descriptor_size), cells_(cells), low_(low), high_(high) {
  HBR_CHECK(cells > 0 && high > low, "{} cells over [{}, {}]", cells, low, high);
  std::size_t total = 1;
  for (int d = 0; d < descriptor_size; ++d) total *= static_cast<std::size_t>(cells);
  slot_of_cell_.assign(total, kNoSlot);
}

std::size_t GridArchive::cell_of(const float* descriptor) const {
  std::size_t index = 0;
  for (int d = 0; d < store_.descriptor_size(); ++d) {
    const float c = (descriptor[d] - low_) / (high_ - low_) * static_cast<float>(cells_);
    index = index * cells_ + std::clamp(static_cast<int>(c), 0, cells_ - 1);
  }
  return index;
}

Added GridArchive::add(const Candidate& c) {
  Slot& slot = slot_of_cell_[cell_of(c.descriptor)];
  if (slot == kNoSlot) return {Outcome::kNovel, slot = store_.append(c)};
  if (c.fitness <= store_.fitness(slot)) return {Outcome::kRejected, kNoSlot};
  store_.replace(slot, c);
  return {Outcome::kReplaced, slot};
}

void GridArchive::restore(const Elites& elites) {
  for (Eigen::Index i = 0; i < elites.size(); ++i) add(candidate_of(elites, i));
}

}  // namespace hbr
