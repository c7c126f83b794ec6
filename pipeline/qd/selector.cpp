#include "pipeline/qd/selector.h"

#include <algorithm>

#include "pipeline/core/check.h"

namespace hbr {
namespace {
constexpr std::int64_t kReward = 2, kPenalty = -1;  // halves
}

CuriositySelector::Node CuriositySelector::merge(const Node& a, const Node& b) {
  if (a.count == 0) return b;
  if (b.count == 0) return a;
  return {a.sum + b.sum, std::min(a.least, b.least), a.count + b.count};
}

void CuriositySelector::set(Slot slot, std::int64_t score) {
  const auto index = static_cast<std::size_t>(slot);
  while (index >= leaves_) {  // double the leaves: the old tree becomes the left half
    std::vector<Node> larger(4 * leaves_);
    for (std::size_t level = 1; level <= leaves_; level *= 2)
      std::copy_n(tree_.begin() + level, level, larger.begin() + 2 * level);
    leaves_ *= 2;
    tree_ = std::move(larger);
    tree_[1] = merge(tree_[2], tree_[3]);
  }
  std::size_t node = leaves_ + index;
  tree_[node] = {score, score, 1};
  while (node /= 2) tree_[node] = merge(tree_[2 * node], tree_[2 * node + 1]);
}

void CuriositySelector::learn(Slot parent, const Added& child) {
  if (parent != kNoSlot && parent != child.slot)
    set(parent, tree_[leaves_ + parent].sum + (child.outcome == Outcome::kRejected ? kPenalty : kReward));
  if (child.outcome != Outcome::kRejected) set(child.slot, 0);
}

Slot CuriositySelector::draw(Slot size, Rng& rng) const {
  HBR_CHECK(tree_[1].count == size, "{} scores for {} elites", tree_[1].count, size);
  const std::int64_t floor = std::min<std::int64_t>(0, tree_[1].least);
  const auto weight = [&](const Node& n) { return n.sum - n.count * floor; };
  const std::int64_t total = weight(tree_[1]);
  if (total == 0) return static_cast<Slot>(rng.below(size));
  auto target = static_cast<std::int64_t>(rng.uniform_double() * static_cast<double>(total));
  target = std::min(target, total - 1);
  std::size_t node = 1;
  while (node < leaves_) {
    node *= 2;
    if (const std::int64_t left = weight(tree_[node]); target >= left) {
      target -= left;
      ++node;
    }
  }
  return static_cast<Slot>(node - leaves_);
}

std::vector<std::int64_t> CuriositySelector::memory() const {
  std::vector<std::int64_t> scores;
  for (std::int64_t i = 0; i < tree_[1].count; ++i) scores.push_back(tree_[leaves_ + i].sum);
  return scores;
}

void CuriositySelector::restore(const std::vector<std::int64_t>& memory) {
  for (std::size_t i = 0; i < memory.size(); ++i) set(static_cast<Slot>(i), memory[i]);
}

}  // namespace hbr
