#include "models/judge/surest.h"

#include <utility>

namespace hbr::inline judge {

std::vector<std::size_t> surest_of_each_class(const JudgedDigits& digits) {
  const auto rank = [&](std::size_t i) { return std::pair(digits.good[i] != 0, digits.confidence[i]); };
  const std::size_t n = digits.label.size();
  std::vector<std::size_t> result;
  for (int label = 0; label < 10; ++label) {
    std::size_t best = n;
    for (std::size_t i = 0; i < n; ++i)
      if (digits.label[i] == label && (best == n || rank(i) > rank(best))) best = i;
    if (best < n) result.push_back(best);
  }
  return result;
}

std::size_t most_legible(const JudgedDigits& digits) {
  const auto rank = [&](std::size_t i) {
    return std::pair(digits.good[i] && digits.label[i] > 1, digits.confidence[i]);
  };
  std::size_t best = 0;
  for (std::size_t i = 1; i < digits.label.size(); ++i)
    if (rank(i) > rank(best)) best = i;
  return best;
}

}  // namespace hbr::inline judge
