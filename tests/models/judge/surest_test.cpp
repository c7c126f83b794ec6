#include "models/judge/surest.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <numeric>

#include "pipeline/core/random.h"

namespace hbr {
namespace {

JudgedDigits random_digits(Rng& rng, std::uint32_t classes) {
  JudgedDigits digits;
  for (std::uint32_t i = 0, n = 1 + rng.below(40); i < n; ++i) {
    digits.label.push_back(static_cast<std::uint8_t>(rng.below(classes)));
    digits.good.push_back(static_cast<std::uint8_t>(rng.below(4) == 0));
    digits.confidence.push_back(static_cast<float>(rng.below(8)));  // some are alike
  }
  return digits;
}

// By sorting all of them, the first of those that are alike first.
template <class Keep, class Prefer>
std::vector<std::size_t> sorted(const JudgedDigits& digits, Keep keep, Prefer prefer) {
  std::vector<std::size_t> all(digits.label.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  std::erase_if(all, [&](std::size_t i) { return !keep(i); });
  std::ranges::stable_sort(all, [&](std::size_t a, std::size_t b) {
    if (prefer(a) != prefer(b)) return prefer(a);
    return digits.confidence[a] > digits.confidence[b];
  });
  return all;
}

TEST(Surest, IsTheFirstOfAllOfItsClassInOrder) {
  Rng rng(Seed(1).child("surest"));
  for (int trial = 0; trial < 200; ++trial) {
    const JudgedDigits digits = random_digits(rng, 10);
    std::vector<std::size_t> expected;
    for (int label = 0; label < 10; ++label) {
      const auto all = sorted(
          digits, [&](std::size_t i) { return digits.label[i] == label; },
          [&](std::size_t i) { return digits.good[i] != 0; });
      if (!all.empty()) expected.push_back(all[0]);
    }
    EXPECT_EQ(surest_of_each_class(digits), expected);
  }
}

TEST(Surest, TheMostLegibleIsNeither0Nor1WhereThereIsAnother) {
  Rng rng(Seed(2).child("surest"));
  for (int trial = 0; trial < 200; ++trial) {
    const JudgedDigits digits = random_digits(rng, 4);
    const auto all = sorted(
        digits, [](std::size_t) { return true; },
        [&](std::size_t i) { return digits.good[i] != 0 && digits.label[i] > 1; });
    EXPECT_EQ(most_legible(digits), all[0]);
  }
}

}  // namespace
}  // namespace hbr
