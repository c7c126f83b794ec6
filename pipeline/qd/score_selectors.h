// Selectors by scores that are a function of what the repertoire holds: fitness, novelty, and novelty with
// local competition (Cully and Demiris 2017, section III-C). They look at the repertoire once a generation.
#pragma once

#include <memory>
#include <vector>

#include "pipeline/qd/local_scores.h"
#include "pipeline/qd/selector.h"

namespace hbr::inline qd {

// Proportionate selection: an elite's share is its score minus min(0, lowest score), as for curiosity; when
// all shares are 0 every elite is as likely.
class Roulette {
 public:
  void set(const std::vector<float>& scores);
  Slot draw(Rng& rng) const;

 private:
  std::vector<double> upto_;  // [n] sum of the shares of slots 0 to i
};

class ScoreSelector : public Selector {
 public:
  void learn(Slot, const Added& child) final {
    if (child.admission == Admission::kReplaced) replaced_.push_back(child.slot);
  }
  // The repertoire remembers all there is to know.
  std::vector<std::int64_t> memory() const final { return {}; }
  void restore(const std::vector<std::int64_t>&) final {}

 protected:
  std::vector<Slot> replaced_;  // since the last refresh
};

// Proportionate to the fitness.
class FitnessSelector final : public ScoreSelector {
 public:
  void refresh(const EliteStore& store) override;
  Slot draw(Slot size, Rng& rng) const override;

 private:
  std::vector<float> fitness_;
  Roulette roulette_;
};

// Proportionate to the novelty.
class NoveltySelector final : public ScoreSelector {
 public:
  explicit NoveltySelector(std::unique_ptr<LocalScores> scores) : scores_(std::move(scores)) {}
  void refresh(const EliteStore& store) override;
  Slot draw(Slot size, Rng& rng) const override;

 private:
  std::unique_ptr<LocalScores> scores_;
  Roulette roulette_;
};

// Novelty search with local competition (Lehman and Stanley 2011): both scores are objectives. Of two elites
// drawn uniformly the one in the better Pareto front (Deb et al. 2002, non-dominated sorting) is taken, the
// first of two in the same.
class NslcSelector final : public ScoreSelector {
 public:
  explicit NslcSelector(std::unique_ptr<LocalScores> scores) : scores_(std::move(scores)) {}
  void refresh(const EliteStore& store) override;
  Slot draw(Slot size, Rng& rng) const override;

  // By slot; 0 is the front that nothing dominates.
  const std::vector<int>& front() const { return front_; }

 private:
  std::unique_ptr<LocalScores> scores_;
  std::vector<Slot> order_;  // the most novel first, of those as novel the one that outperforms more
  std::vector<int> front_;
};

}  // namespace hbr::inline qd
