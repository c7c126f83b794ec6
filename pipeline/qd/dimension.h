// From a descriptor's size, known when the program runs, to code compiled for it.
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

}  // namespace hbr::inline qd
