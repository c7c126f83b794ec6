// A grid container (MAP-Elites, Mouret and Clune 2015): one elite per cell of a grid, the fittest.
#pragma once

#include "pipeline/qd/cell_archive.h"

namespace hbr {

class GridArchive final : public CellArchive {
 public:
  // The box [low, high]^d in `cells` cells a side; a descriptor outside belongs to the nearest cell.
  GridArchive(int genes, int descriptor_size, int cells, float low, float high);

 private:
  std::size_t cell_of(const float* descriptor) const override;

  int cells_;
  float low_, high_;
};

}  // namespace hbr
