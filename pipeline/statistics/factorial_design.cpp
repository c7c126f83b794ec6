#include "pipeline/statistics/factorial_design.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>

#include "pipeline/core/check.h"
#include "pipeline/core/random.h"

namespace hbr::inline statistics {
namespace {

constexpr std::int64_t kMostCombinations = 65536;
// Of the search for a balanced choice: tries from random choices, fewer where each is long.
constexpr std::size_t kMostTries = 300, kWork = 10'000'000;

std::vector<Levels> all_combinations(const std::vector<int>& levels) {
  std::int64_t count = 1;
  for (const int n : levels) {
    HBR_CHECK(n >= 2, "a factor of {} levels", n);
    count *= n;
    if (count > kMostCombinations)
      throw InputError("more than {} combinations; expected fewer factors or levels", kMostCombinations);
  }
  std::vector<Levels> all;
  Levels now(levels.size(), 0);
  for (std::int64_t i = 0; i < count; ++i) {
    all.push_back(now);
    for (std::size_t f = levels.size(); f-- > 0;) {
      if (++now[f] < levels[f]) break;
      now[f] = 0;
    }
  }
  return all;
}

std::int64_t agreement(const std::vector<int>& levels, const Levels& a, const Levels& b) {
  std::int64_t sum = 0;
  for (std::size_t f = 0; f < levels.size(); ++f) sum += a[f] == b[f] ? levels[f] : 0;
  return sum * sum * sum * sum;
}

// Chosen rows of `all`, and for every row how much it agrees with the chosen ones.
class Chooser {
 public:
  // The first row, and others drawn at random.
  Chooser(const std::vector<int>& levels, const std::vector<Levels>& all, std::size_t runs, Seed seed)
      : levels_(levels), all_(all), cost_(all.size(), 0), taken_(all.size(), 0) {
    add(0);
    Rng rng(seed);
    while (chosen_.size() < runs)
      if (const std::size_t row = rng.below(static_cast<std::uint32_t>(all.size())); !taken_[row]) add(row);
  }

  // Exchanges rows, but the first, as long as one becomes better by it.
  void improve() {
    for (bool better = true; better;) {
      better = false;
      for (std::size_t i = 1; i < chosen_.size(); ++i) {
        const std::size_t old = chosen_[i];
        remove(i);
        const std::size_t next = cheapest();
        better = better || cost_[next] < cost_[old];
        add(cost_[next] < cost_[old] ? next : old);
        std::rotate(chosen_.begin() + static_cast<std::ptrdiff_t>(i), chosen_.end() - 1, chosen_.end());
      }
    }
  }
  std::int64_t total() const {
    std::int64_t sum = 0;
    for (const std::size_t row : chosen_) sum += cost_[row];
    return sum;
  }
  std::vector<Levels> rows() {
    std::ranges::sort(chosen_);
    std::vector<Levels> rows;
    for (const std::size_t i : chosen_) rows.push_back(all_[i]);
    return rows;
  }

 private:
  void change(std::size_t row, std::int64_t sign) {
    for (std::size_t i = 0; i < all_.size(); ++i) cost_[i] += sign * agreement(levels_, all_[row], all_[i]);
    taken_[row] = sign > 0;
  }
  void add(std::size_t row) {
    change(row, 1);
    chosen_.push_back(row);
  }
  void remove(std::size_t place) {
    change(chosen_[place], -1);
    chosen_.erase(chosen_.begin() + static_cast<std::ptrdiff_t>(place));
  }
  std::size_t cheapest() const {
    std::size_t best = 0;
    auto least = std::numeric_limits<std::int64_t>::max();
    for (std::size_t i = 0; i < all_.size(); ++i)
      if (!taken_[i] && cost_[i] < least) {
        least = cost_[i];
        best = i;
      }
    return best;
  }

  const std::vector<int>& levels_;
  const std::vector<Levels>& all_;
  std::vector<std::int64_t> cost_;
  std::vector<std::uint8_t> taken_;
  std::vector<std::size_t> chosen_;
};

}  // namespace

std::vector<Levels> factorial_design(const std::vector<int>& levels, int runs) {
  std::vector<Levels> all = all_combinations(levels);
  if (runs <= 0 || static_cast<std::size_t>(runs) >= all.size()) return all;
  const auto wanted = static_cast<std::size_t>(runs);
  const std::size_t tries = std::clamp<std::size_t>(kWork / (all.size() * wanted), 1, kMostTries);
  std::optional<Chooser> best;
  for (std::size_t i = 0; i < tries; ++i) {
    Chooser chooser(levels, all, wanted, Seed(0).child("factorial design").child(i));
    chooser.improve();
    if (!best || chooser.total() < best->total()) best.emplace(std::move(chooser));
  }
  return best->rows();
}

}  // namespace hbr::inline statistics
