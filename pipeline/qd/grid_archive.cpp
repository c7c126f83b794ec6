#include "pipeline/qd/grid_archive.h"

#include <algorithm>

#include "pipeline/core/check.h"

namespace hbr {
namespace {

std::size_t power(int cells, int dimensions) {
  std::size_t total = 1;
  for (int d = 0; d < dimensions; ++d) total *= static_cast<std::size_t>(cells);
  return total;
}

}  // namespace

GridArchive::GridArchive(int genes, int descriptor_size, int cells, float low, float high)
    : CellArchive(genes, descriptor_size, power(cells, descriptor_size)),
      cells_(cells),
      low_(low),
      high_(high) {
  HBR_CHECK(cells > 0 && high > low, "{} cells over [{}, {}]", cells, low, high);
}

std::size_t GridArchive::cell_of(const float* descriptor) const {
  std::size_t index = 0;
  for (int d = 0; d < store_.descriptor_size(); ++d) {
    const float c = (descriptor[d] - low_) / (high_ - low_) * static_cast<float>(cells_);
    index = index * cells_ + std::clamp(static_cast<int>(c), 0, cells_ - 1);
  }
  return index;
}

}  // namespace hbr
