// How an elite stands among its neighbours (Lehman and Stanley 2011, novelty search with local competition):
// its novelty, the mean distance to the k nearest elites, and how many of those k it outperforms.
//
// Only what a change can have touched is computed again: the elites that count the old or the new place of a
// changed elite among their k nearest.
#pragma once

#include <memory>
#include <vector>

#include "pipeline/qd/elite_store.h"

namespace hbr::inline qd {

class LocalScores {
 public:
  virtual ~LocalScores() = default;

  // Brings the scores up to date with the store. `replaced`: the slots that have been given another elite
  // since the last update; those of new elites are found by the store's size.
  virtual void update(const EliteStore& store, const std::vector<Slot>& replaced) = 0;

  // By slot. With fewer than k other elites all of them count; a lone elite has novelty 0.
  const std::vector<float>& novelty() const { return novelty_; }
  const std::vector<int>& outperformed() const { return outperformed_; }
  // The slots whose scores the last update computed, ascending.
  const std::vector<Slot>& updated() const { return updated_; }

 protected:
  std::vector<float> novelty_;
  std::vector<int> outperformed_;
  std::vector<Slot> updated_;
};

// descriptor_size: 1 to 8; neighbours (k): 1 to 32; [low, high]: range of the descriptor in every dimension.
std::unique_ptr<LocalScores> make_local_scores(int descriptor_size, int neighbours, float low, float high);

}  // namespace hbr::inline qd
