// A grid container (MAP-Elites, Mouret and Clune 2015): one elite per cell, the fittest.
#pragma once

#include <vector>

#include "pipeline/qd/repertoire.h"

namespace hbr {

class GridArchive final : public Repertoire {
 public:
  // The box [low, high]^d in `cells` cells a side; a descriptor outside belongs to the nearest cell.
  GridArchive(int genes, int descriptor_size, int cells, float low, float high);

  Added add(const Candidate& candidate) override;
  void restore(const Elites& elites) override;

 private:
  std::size_t cell_of(const float* descriptor) const;

  int cells_;
  float low_, high_;
  std::vector<Slot> slot_of_cell_;
};

}  // namespace hbr
