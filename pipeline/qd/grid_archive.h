// A grid container (MAP-Elites, Mouret and Clune 2015): one elite per cell of a grid, the fittest.
#pragma once

#include "pipeline/qd/cell_archive.h"

namespace hbr::inline qd {

// The box [low, high]^d in `cells` cells a side; a descriptor outside belongs to the nearest cell.
struct GridCells {
  int descriptor_size, cells;
  float low, high;

  std::size_t size() const;  // cells^d
  std::size_t cell_of(const float* descriptor) const;
};

class GridArchive final : public CellArchive {
 public:
  GridArchive(int genes, const GridCells& cells)
      : CellArchive(genes, cells.descriptor_size, cells.size()), cells_(cells) {}

 private:
  std::size_t cell_of(const float* descriptor) const override { return cells_.cell_of(descriptor); }
  GridCells cells_;
};

}  // namespace hbr::inline qd
