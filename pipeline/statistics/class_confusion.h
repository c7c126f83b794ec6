// Which classes lie among each other in a space.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace hbr::inline statistics {

inline constexpr std::size_t kDigitClasses = 10;

// [of class][as class]: points of a class whose nearest other point is of a class; of several as near the
// first one counts. `position` [n x dimension] and `label` [n], 0 to 9. Throws InputError where they do not
// fit together or are fewer than two.
using ClassCounts = std::array<std::array<double, kDigitClasses>, kDigitClasses>;
ClassCounts nearest_classes(std::span<const float> position, std::span<const std::uint8_t> label);

}  // namespace hbr::inline statistics
