// How parents are drawn.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "pipeline/core/random.h"
#include "pipeline/qd/repertoire.h"

namespace hbr::inline qd {

class Selector {
 public:
  virtual ~Selector() = default;
  // Called before the parents of a generation are drawn, for selectors that look at the elites themselves;
  // the store is not empty.
  virtual void refresh(const EliteStore&) {}
  // A slot of a repertoire of `size` > 0 elites.
  virtual Slot draw(Slot size, Rng& rng) const = 0;
  // What became of a child. `parent` is kNoSlot when it was drawn at random or its parent has been replaced
  // since.
  virtual void learn(Slot parent, const Added& child) = 0;
  // What the selector has learnt, per slot, for a checkpoint; empty where it learns nothing.
  virtual std::vector<std::int64_t> memory() const = 0;
  virtual void restore(const std::vector<std::int64_t>& memory) = 0;
};

// Every elite with the same probability.
class UniformSelector final : public Selector {
 public:
  Slot draw(Slot size, Rng& rng) const override { return static_cast<Slot>(rng.below(size)); }
  void learn(Slot, const Added&) override {}
  std::vector<std::int64_t> memory() const override { return {}; }
  void restore(const std::vector<std::int64_t>&) override {}
};

// Roulette on the curiosity score (Cully and Demiris 2017): +1 when a child enters the repertoire, -0.5 when
// not; an elite starts at 0. An elite's share is its score minus min(0, lowest score); when all shares are 0
// every elite is as likely. Scores are kept as halves, so that sums are exact; drawing and learning take
// O(log n).
class CuriositySelector final : public Selector {
 public:
  Slot draw(Slot size, Rng& rng) const override;
  void learn(Slot parent, const Added& child) override;
  std::vector<std::int64_t> memory() const override;
  void restore(const std::vector<std::int64_t>& memory) override;

 private:
  static constexpr std::int64_t kUnused = std::numeric_limits<std::int64_t>::max();
  void set(Slot slot, std::int64_t score);

  // A complete binary tree over the slots, the root at 1, the leaves from leaves_ on: sum and least of the
  // scores below a node.
  std::vector<std::int64_t> sum_ = std::vector<std::int64_t>(2, 0);
  std::vector<std::int64_t> least_ = std::vector<std::int64_t>(2, kUnused);
  std::size_t leaves_ = 1;
  Slot size_ = 0;
};

}  // namespace hbr::inline qd
