#include "pipeline/qd/selector.h"

#include <algorithm>

#include "pipeline/core/check.h"

namespace hbr::inline qd {
namespace {
constexpr std::int64_t kReward = 2, kPenalty = -1;  // halves
}

void CuriositySelector::set(Slot slot, std::int64_t score) {
  const auto index = static_cast<std::size_t>(slot);
  size_ = std::max(size_, slot + 1);
  while (index >= leaves_) {  // double the leaves: the old tree becomes the left half
    std::vector<std::int64_t> sum(4 * leaves_, 0), least(4 * leaves_, kUnused);
    for (std::size_t level = 1; level <= leaves_; level *= 2) {
      std::copy_n(sum_.begin() + level, level, sum.begin() + 2 * level);
      std::copy_n(least_.begin() + level, level, least.begin() + 2 * level);
    }
    sum[1] = sum_[1];
    least[1] = least_[1];
    leaves_ *= 2;
    sum_ = std::move(sum);
    least_ = std::move(least);
  }
  std::size_t node = leaves_ + index;
  const std::int64_t change = score - sum_[node];
  sum_[node] = least_[node] = score;
  while (node /= 2) {
    sum_[node] += change;
    least_[node] = std::min(least_[2 * node], least_[2 * node + 1]);
  }
}

void CuriositySelector::learn(Slot parent, const Added& child) {
  if (parent != kNoSlot && parent != child.slot)
    set(parent, sum_[leaves_ + parent] + (child.admission == Admission::kRejected ? kPenalty : kReward));
  if (child.admission != Admission::kRejected) set(child.slot, 0);
}

Slot CuriositySelector::draw(Slot size, Rng& rng) const {
  HBR_CHECK(size_ == size, "{} scores for {} elites", size_, size);
  const std::int64_t floor = std::min<std::int64_t>(0, least_[1]);
  const std::int64_t total = sum_[1] - size * floor;
  if (total == 0) return static_cast<Slot>(rng.below(size));
  auto target = static_cast<std::int64_t>(rng.uniform_double() * static_cast<double>(total));
  target = std::min(target, total - 1);
  // The slots below a node are first, ..., first + span - 1; those that are in use are the first ones.
  std::size_t node = 1;
  std::int64_t first = 0;
  for (auto span = static_cast<std::int64_t>(leaves_) / 2; span > 0; span /= 2) {
    node *= 2;
    const std::int64_t used = std::clamp<std::int64_t>(size - first, 0, span);
    const std::int64_t left = sum_[node] - used * floor;
    const bool right = target >= left;
    target -= right ? left : 0;
    first += right ? span : 0;
    node += right;
  }
  return static_cast<Slot>(first);
}

std::vector<std::int64_t> CuriositySelector::memory() const {
  return {sum_.begin() + static_cast<std::ptrdiff_t>(leaves_),
          sum_.begin() + static_cast<std::ptrdiff_t>(leaves_) + size_};
}

void CuriositySelector::restore(const std::vector<std::int64_t>& memory) {
  for (std::size_t i = 0; i < memory.size(); ++i) set(static_cast<Slot>(i), memory[i]);
}

}  // namespace hbr::inline qd
