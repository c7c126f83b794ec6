#include "pipeline/qd/cell_archive.h"

#include "pipeline/core/check.h"

namespace hbr::inline qd {

Added CellArchive::add(const Candidate& c) {
  Slot& slot = slot_of_cell_[cell_of(c.descriptor)];
  if (slot == kNoSlot) return {Admission::kNovel, slot = store_.append(c)};
  if (c.fitness <= store_.fitness(slot)) return {Admission::kRejected, kNoSlot};
  store_.replace(slot, c);
  return {Admission::kReplaced, slot};
}

void CellArchive::restore(const Elites& elites) {
  HBR_CHECK(size() == 0, "size {}", size());
  for (Eigen::Index i = 0; i < elites.size(); ++i) add(candidate_of(elites, i));
}

}  // namespace hbr::inline qd
