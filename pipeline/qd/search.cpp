#include "pipeline/qd/search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "pipeline/core/check.h"

namespace hbr::inline qd {
namespace {
// Children that one task breeds: few enough to balance. They are evaluated by groups of as many as a learned
// descriptor works on at once, so that none of its lanes is idle.
constexpr std::size_t kGrain = 25;
constexpr int kGroup = 16;
}  // namespace

Search::Search(Repertoire& repertoire, Selector& selector, const Variation& variation,
               const Evaluator& evaluator, const SearchSettings& settings, Seed seed)
    : repertoire_(repertoire),
      selector_(selector),
      variation_(variation),
      evaluator_(evaluator),
      settings_(settings),
      seed_(seed),
      batch_(settings.batch, variation.genes(), evaluator.descriptor_size()),
      parent_slot_(settings.batch, kNoSlot),
      parent_id_(settings.batch, -1),
      credited_(settings.batch),
      copy_(settings.batch, 0),
      fresh_(settings.batch, variation.genes(), evaluator.descriptor_size()) {
  HBR_CHECK(settings.generations > 0 && settings.batch > 0 && settings.record_every > 0, "{} x {}, every {}",
            settings.generations, settings.batch, settings.record_every);
  std::iota(credited_.begin(), credited_.end(), 0);
}

void Search::step(Workers& workers) {
  select_parents();
  breed(workers);
  evaluate(workers);
  add();
  ++generation_;
  if (generation_ % settings_.record_every == 0 || done()) record();
}

void Search::select_parents() {
  Rng rng(seed_.child("selection").child(generation_));
  const bool at_random = generation_ == 0 || repertoire_.size() == 0;
  if (!at_random) selector_.refresh(repertoire_.store());
  for (int i = 0; i < settings_.batch; ++i) {
    parent_slot_[i] = at_random ? kNoSlot : selector_.draw(repertoire_.size(), rng);
    parent_id_[i] = at_random ? -1 : repertoire_.store().id(parent_slot_[i]);
  }
  if (settings_.credit == Credit::kParent) return;
  std::iota(credited_.begin(), credited_.end(), 0);
  Rng shuffle(seed_.child("credit").child(generation_));
  for (int i = settings_.batch - 1; i > 0; --i) std::swap(credited_[i], credited_[shuffle.below(i + 1)]);
}

void Search::breed(Workers& workers) {
  const Seed seed = seed_.child("variation").child(generation_);
  const EliteStore& store = repertoire_.store();
  workers.for_ranges(settings_.batch, kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Rng rng(seed.child(i));
      float* child = batch_.genome.row(i).data();
      const Slot p = parent_slot_[i];
      if (p == kNoSlot) {
        batch_.length[i] = variation_.sample(child, rng);
        copy_[i] = 0;
        continue;
      }
      const int length = batch_.length[i] = variation_.vary(store.genome(p), store.length(p), child, rng);
      copy_[i] = evaluator_.deterministic() && length == store.length(p) &&
                 std::equal(child, child + length, store.genome(p));
    }
  });
}

void Search::evaluate(Workers& workers) {
  const Seed seed = seed_.child("evaluation").child(generation_);
  const auto run = [&](Batch& batch, int rows) {
    workers.for_ranges((rows + kGroup - 1) / kGroup, 2, [&](std::size_t begin, std::size_t end) {
      const auto row = [rows](std::size_t group) { return std::min<Eigen::Index>(group * kGroup, rows); };
      evaluator_.evaluate(batch, row(begin), row(end), seed);
    });
  };
  if (!evaluator_.deterministic()) return run(batch_, settings_.batch);

  int rows = 0;
  for (int i = 0; i < settings_.batch; ++i) {
    if (copy_[i]) continue;
    fresh_.genome.row(rows) = batch_.genome.row(i);
    fresh_.length[rows++] = batch_.length[i];
  }
  run(fresh_, rows);
  const EliteStore& store = repertoire_.store();
  rows = 0;
  for (int i = 0; i < settings_.batch; ++i) {
    const Slot p = parent_slot_[i];
    const float* descriptor = copy_[i] ? store.descriptor(p) : fresh_.descriptor.row(rows).data();
    std::copy_n(descriptor, store.descriptor_size(), batch_.descriptor.row(i).data());
    batch_.fitness[i] = copy_[i] ? store.fitness(p) : fresh_.fitness[rows];
    batch_.uncertainty[i] = copy_[i] ? store.uncertainty(p) : fresh_.uncertainty[rows];
    batch_.valid[i] = copy_[i] || fresh_.valid[rows];
    rows += !copy_[i];
  }
}

void Search::add() {
  const auto parent_is_there = [&](int i) {
    return parent_slot_[i] != kNoSlot && repertoire_.store().id(parent_slot_[i]) == parent_id_[i];
  };
  for (int i = 0; i < settings_.batch; ++i) {
    Added added{Admission::kRejected, kNoSlot};
    if (batch_.valid[i] && !(copy_[i] && parent_is_there(i))) {
      HBR_CHECK(batch_.descriptor.row(i).allFinite() && std::isfinite(batch_.fitness[i]),
                "generation {}, child {}: descriptor or fitness is not finite", generation_, i);
      added = repertoire_.add({batch_.genome.row(i).data(), batch_.length[i], batch_.descriptor.row(i).data(),
                               batch_.fitness[i], batch_.uncertainty[i], generation_ * settings_.batch + i,
                               parent_id_[i]});
    }
    // A sibling may have taken the parent's place; then there is nobody to credit.
    const int credited = credited_[i];
    const bool replaced_by_child = added.slot != kNoSlot && parent_slot_[credited] == added.slot;
    selector_.learn(replaced_by_child || parent_is_there(credited) ? parent_slot_[credited] : kNoSlot, added);
  }
}

void Search::record() {
  const EliteStore& store = repertoire_.store();
  double best = -std::numeric_limits<double>::infinity(), sum = 0;
  for (Slot s = 0; s < store.size(); ++s) {
    best = std::max(best, static_cast<double>(store.fitness(s)));
    sum += store.fitness(s);
  }
  if (store.size() == 0) return;  // nothing to speak of yet
  progress_.push_back({generation_, store.size(), best, sum / store.size(), generation_ * settings_.batch});
}

SearchState Search::state() const {
  return {generation_, repertoire_.store().in_slot_order(), selector_.memory(), progress_};
}

void Search::resume(const SearchState& state) {
  HBR_CHECK(generation_ == 0, "generation {}", generation_);
  generation_ = state.generation;
  repertoire_.restore(state.elites);
  selector_.restore(state.selector);
  progress_ = state.progress;
}

}  // namespace hbr::inline qd
