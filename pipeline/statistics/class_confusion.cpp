#include "pipeline/statistics/class_confusion.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

#include "pipeline/core/check.h"

namespace hbr::inline statistics {

ClassCounts nearest_classes(std::span<const float> position, std::span<const std::uint8_t> label) {
  const std::size_t n = label.size(), dimension = n > 0 ? position.size() / n : 0;
  if (n < 2 || dimension == 0 || position.size() != n * dimension ||
      std::ranges::any_of(label, [](std::uint8_t c) { return c >= kDigitClasses; }))
    throw InputError(
        "{} coordinates of {} labelled points; expected as many for each of at least two, and "
        "labels from 0 to 9",
        position.size(), n);
  // In the order of the first coordinate, so that those are passed over that it alone keeps away.
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return position[i * dimension]; });
  ClassCounts counts{};
  for (std::size_t at = 0; at < n; ++at) {
    const std::size_t of = order[at];
    double least = std::numeric_limits<double>::infinity();
    std::size_t nearest = n;
    // Whether points farther along the order may still be as near.
    const auto try_point = [&](std::size_t i) {
      double square = 0;
      for (std::size_t d = 0; d < dimension; ++d) {
        const double gap = static_cast<double>(position[i * dimension + d]) -
                           static_cast<double>(position[of * dimension + d]);
        square += gap * gap;
        if (d == 0 && square > least) return false;
      }
      if (square < least || (square == least && i < nearest)) least = square, nearest = i;
      return true;
    };
    for (std::size_t k = at + 1; k < n && try_point(order[k]);) ++k;
    for (std::size_t k = at; k > 0 && try_point(order[k - 1]);) --k;
    counts[label[of]][label[nearest]] += 1;
  }
  return counts;
}

}  // namespace hbr::inline statistics
