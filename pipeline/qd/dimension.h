// From a descriptor's size, known when the program runs, to code compiled for it; and from a coordinate to a
// cell.
#pragma once

#include <type_traits>

#include "pipeline/core/check.h"

namespace hbr::inline qd {

inline constexpr int kMaxDescriptorSize = 8;

// make(std::integral_constant<int, D>()) with D = size, 1 to 8.
template <int D = 1, class Make>
auto with_dimension(int size, Make&& make) {
  if constexpr (D < kMaxDescriptorSize) {
    if (size != D) return with_dimension<D + 1>(size, make);
  }
  HBR_CHECK(size == D, "descriptor size {}, expected 1 to {}", size, kMaxDescriptorSize);
  return make(std::integral_constant<int, D>());
}

// The whole part of c, as one of `cells` from 0; the nearest of them where c lies outside, however far.
inline int nearest_cell(float c, int cells) {
  return !(c > 0) ? 0 : c >= static_cast<float>(cells) ? cells - 1 : static_cast<int>(c);
}

}  // namespace hbr::inline qd
