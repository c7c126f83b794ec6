// The container and the selector of archive-curiosity without any structure: every rule a scan of all elites.
// The tests' second opinion and the benchmarks' reference.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "pipeline/core/check.h"
#include "pipeline/qd/distance_archive.h"
#include "pipeline/qd/selector.h"

namespace hbr {

class NaiveArchive final : public Repertoire {
 public:
  NaiveArchive(int genes, int descriptor_size, const DistanceArchiveSettings& settings)
      : Repertoire(genes, descriptor_size), settings_(settings) {}

  Added add(const Candidate& c) override {
    const std::vector<Near> near = neighbours(c.descriptor, kNoSlot);
    const float l = settings_.spacing, eps = settings_.epsilon;
    if (near.empty() || near[0].first > l * l) return {Admission::kNovel, store_.append(c)};
    const float inner = (1 - eps) * l;
    if (size() == 1 || near[1].first < inner * inner) return {Admission::kRejected, kNoSlot};
    const Slot other = near[0].second;
    const float q = c.fitness, q0 = store_.fitness(other);
    const float n = novelty(near), n0 = novelty(neighbours(store_.descriptor(other), other));
    if (q < q0 - eps * std::abs(q0) || n < (1 - eps) * n0 || !((q - q0) * n0 > -(n - n0) * std::abs(q0)))
      return {Admission::kRejected, kNoSlot};
    store_.replace(other, c);
    return {Admission::kReplaced, other};
  }
  void restore(const Elites& elites) override {
    for (Eigen::Index i = 0; i < elites.size(); ++i) store_.append(candidate_of(elites, i));
  }

 private:
  using Near = std::pair<float, Slot>;  // squared distance

  // The k + 1 nearest, nearest first.
  std::vector<Near> neighbours(const float* point, Slot excluded) const {
    std::vector<Near> near;
    for (Slot s = 0; s < size(); ++s) {
      if (s == excluded) continue;
      float squared = 0;
      for (int d = 0; d < store_.descriptor_size(); ++d) {
        const float offset = store_.descriptor(s)[d] - point[d];
        squared += offset * offset;
      }
      near.emplace_back(squared, s);
    }
    const auto most = std::min<std::size_t>(near.size(), settings_.neighbours);
    std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(most), near.end());
    near.resize(most);
    return near;
  }
  static float novelty(const std::vector<Near>& near) {
    float sum = 0;
    for (const auto& [squared, slot] : near) sum += std::sqrt(squared);
    return sum / static_cast<float>(near.size());
  }

  DistanceArchiveSettings settings_;
};

class NaiveRoulette final : public Selector {
 public:
  Slot draw(Slot size, Rng& rng) const override {
    const std::int64_t floor = std::min<std::int64_t>(0, *std::min_element(halves_.begin(), halves_.end()));
    std::int64_t total = 0;
    for (const std::int64_t score : halves_) total += score - floor;
    if (total == 0) return static_cast<Slot>(rng.below(size));
    auto target = static_cast<std::int64_t>(rng.uniform_double() * static_cast<double>(total));
    Slot slot = 0;
    while (target >= halves_[slot] - floor) target -= halves_[slot++] - floor;
    return slot;
  }
  void learn(Slot parent, const Added& child) override {
    const bool rejected = child.admission == Admission::kRejected;
    if (parent != kNoSlot && parent != child.slot) halves_[parent] += rejected ? -1 : 2;
    if (rejected) return;
    if (static_cast<std::size_t>(child.slot) == halves_.size()) halves_.push_back(0);
    halves_[child.slot] = 0;
  }
  std::vector<std::int64_t> memory() const override { return halves_; }
  void restore(const std::vector<std::int64_t>& memory) override { halves_ = memory; }

 private:
  std::vector<std::int64_t> halves_;
};

}  // namespace hbr
