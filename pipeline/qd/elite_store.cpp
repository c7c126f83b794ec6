#include "pipeline/qd/elite_store.h"

#include <algorithm>
#include <numeric>

#include "pipeline/core/check.h"

namespace hbr {

Slot EliteStore::append(const Candidate& candidate) {
  const Slot slot = size();
  genome_.resize(genome_.size() + genes_, 0.0f);
  descriptor_.resize(descriptor_.size() + descriptor_size_);
  fitness_.emplace_back();
  uncertainty_.emplace_back();
  length_.emplace_back();
  id_.emplace_back();
  parent_.emplace_back();
  replace(slot, candidate);
  return slot;
}

void EliteStore::replace(Slot slot, const Candidate& c) {
  HBR_CHECK(c.length <= genes_, "length {}, genes {}", c.length, genes_);
  float* genome = &genome_[static_cast<std::size_t>(slot) * genes_];
  std::copy_n(c.genome, c.length, genome);
  std::fill(genome + c.length, genome + genes_, 0.0f);
  std::copy_n(c.descriptor, descriptor_size_,
              &descriptor_[static_cast<std::size_t>(slot) * descriptor_size_]);
  fitness_[slot] = c.fitness;
  uncertainty_[slot] = c.uncertainty;
  length_[slot] = c.length;
  id_[slot] = c.id;
  parent_[slot] = c.parent;
}

Elites EliteStore::gather(const std::vector<Slot>& order) const {
  const auto n = static_cast<Eigen::Index>(order.size());
  Elites out;
  out.solution.resize(n, genes_);
  out.measures.resize(n, descriptor_size_);
  out.objective.resize(n);
  out.uncertainty.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Slot s = order[i];
    out.solution.row(i) = Eigen::Map<const Eigen::RowVectorXf>(genome(s), genes_);
    out.measures.row(i) = Eigen::Map<const Eigen::RowVectorXf>(descriptor(s), descriptor_size_);
    out.objective[i] = fitness_[s];
    out.uncertainty[i] = uncertainty_[s];
    out.length.push_back(length_[s]);
    out.id.push_back(id_[s]);
    out.parent.push_back(parent_[s]);
  }
  return out;
}

Elites EliteStore::in_slot_order() const {
  std::vector<Slot> order(id_.size());
  std::iota(order.begin(), order.end(), 0);
  return gather(order);
}

Elites EliteStore::in_id_order() const {
  std::vector<Slot> order(id_.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](Slot a, Slot b) { return id_[a] < id_[b]; });
  return gather(order);
}

}  // namespace hbr
