#include "pipeline/qd/score_selectors.h"

#include <algorithm>
#include <tuple>

#include "pipeline/core/check.h"

namespace hbr::inline qd {

void Roulette::set(const std::vector<float>& scores) {
  const double floor = std::min(0.0f, *std::min_element(scores.begin(), scores.end()));
  upto_.resize(scores.size());
  double sum = 0;
  for (std::size_t i = 0; i < scores.size(); ++i) upto_[i] = sum += static_cast<double>(scores[i]) - floor;
}

Slot Roulette::draw(Rng& rng) const {
  const double total = upto_.back();
  if (total == 0) return static_cast<Slot>(rng.below(upto_.size()));
  // Below the total, so found; and never one whose share is 0.
  const auto found = std::upper_bound(upto_.begin(), upto_.end(), rng.uniform_double() * total);
  return static_cast<Slot>(found - upto_.begin());
}

void FitnessSelector::refresh(const EliteStore& store) {
  replaced_.clear();
  fitness_.resize(store.size());
  for (Slot s = 0; s < store.size(); ++s) fitness_[s] = store.fitness(s);
  roulette_.set(fitness_);
}

Slot FitnessSelector::draw(Slot size, Rng& rng) const {
  HBR_CHECK(static_cast<Slot>(fitness_.size()) == size, "{} scores for {} elites", fitness_.size(), size);
  return roulette_.draw(rng);
}

void NoveltySelector::refresh(const EliteStore& store) {
  scores_->update(store, replaced_);
  replaced_.clear();
  roulette_.set(scores_->novelty());
}

Slot NoveltySelector::draw(Slot size, Rng& rng) const {
  HBR_CHECK(static_cast<Slot>(scores_->novelty().size()) == size, "{} scores for {} elites",
            scores_->novelty().size(), size);
  return roulette_.draw(rng);
}

void NslcSelector::refresh(const EliteStore& store) {
  scores_->update(store, replaced_);
  replaced_.clear();
  const std::vector<float>& novelty = scores_->novelty();
  const std::vector<int>& outperformed = scores_->outperformed();
  const auto before = [&](Slot a, Slot b) {
    return std::tuple(novelty[b], outperformed[b], a) < std::tuple(novelty[a], outperformed[a], b);
  };

  // Those with new scores leave their places in the order and come back at others.
  std::vector<Slot> moved = scores_->updated();
  std::vector<std::uint8_t> has_moved(store.size(), 0);
  for (const Slot s : moved) has_moved[s] = 1;
  std::erase_if(order_, [&](Slot s) { return has_moved[s] != 0; });
  std::sort(moved.begin(), moved.end(), before);
  std::vector<Slot> merged(order_.size() + moved.size());
  std::merge(order_.begin(), order_.end(), moved.begin(), moved.end(), merged.begin(), before);
  order_ = std::move(merged);

  // In this order an elite is dominated by those before it that outperform as many or more, its equals left
  // out; its front is the next after the worst of theirs.
  front_.resize(store.size());
  const int most = *std::max_element(outperformed.begin(), outperformed.end());
  std::vector<int> fronts(most + 1, 0);  // [c] fronts in use among those that outperform c or more
  Slot last = kNoSlot;
  for (const Slot s : order_) {
    const int c = outperformed[s];
    const bool equals_last = last != kNoSlot && novelty[last] == novelty[s] && outperformed[last] == c;
    front_[s] = equals_last ? front_[last] : fronts[c];
    for (int below = c; below >= 0 && fronts[below] <= front_[s]; --below) fronts[below] = front_[s] + 1;
    last = s;
  }
}

Slot NslcSelector::draw(Slot size, Rng& rng) const {
  HBR_CHECK(static_cast<Slot>(front_.size()) == size, "{} fronts for {} elites", front_.size(), size);
  const auto a = static_cast<Slot>(rng.below(size)), b = static_cast<Slot>(rng.below(size));
  return front_[b] < front_[a] ? b : a;
}

}  // namespace hbr::inline qd
