#include "pipeline/qd/grid_archive.h"

#include <algorithm>

#include "pipeline/core/check.h"
#include "pipeline/qd/dimension.h"

namespace hbr::inline qd {

std::size_t GridCells::size() const {
  HBR_CHECK(cells > 0 && high > low, "{} cells over [{}, {}]", cells, low, high);
  constexpr std::size_t kMost = std::size_t{1} << 28;
  std::size_t total = 1;
  for (int d = 0; d < descriptor_size; ++d)
    if ((total *= static_cast<std::size_t>(cells)) > kMost)
      throw InputError(
          "a grid of {} cells in each of {} dimensions; expected at most {} cells in all: fewer grid_cells, "
          "or the container cvt, which has as many as are asked for",
          cells, descriptor_size, kMost);
  return total;
}

std::size_t GridCells::cell_of(const float* descriptor) const {
  std::size_t index = 0;
  for (int d = 0; d < descriptor_size; ++d) {
    const float c = (descriptor[d] - low) / (high - low) * static_cast<float>(cells);
    index = index * cells + nearest_cell(c, cells);
  }
  return index;
}

}  // namespace hbr::inline qd
