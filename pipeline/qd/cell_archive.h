// Containers that cut the descriptor's space into cells: one elite per cell, the fittest; of two as fit the
// first (MAP-Elites, Mouret and Clune 2015).
#pragma once

#include <vector>

#include "pipeline/qd/repertoire.h"

namespace hbr::inline qd {

class CellArchive : public Repertoire {
 public:
  CellArchive(int genes, int descriptor_size, std::size_t cells)
      : Repertoire(genes, descriptor_size), slot_of_cell_(cells, kNoSlot) {}

  Added add(const Candidate& candidate) final;
  void restore(const Elites& elites) final;

 protected:
  // Less than the number of cells, for any finite descriptor.
  virtual std::size_t cell_of(const float* descriptor) const = 0;

 private:
  std::vector<Slot> slot_of_cell_;
};

}  // namespace hbr::inline qd
