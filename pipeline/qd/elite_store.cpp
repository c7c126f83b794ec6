#include "pipeline/qd/elite_store.h"

#include <algorithm>
#include <numeric>

#include "pipeline/core/check.h"

namespace hbr::inline qd {

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

Elites EliteStore::in_slot_order() const {
  const Slot n = size();
  Elites out;
  out.solution = Eigen::Map<const Rows>(genome_.data(), n, genes_);
  out.length = length_;
  out.objective = Eigen::VectorXf::Map(fitness_.data(), n);
  out.measures = Eigen::Map<const Rows>(descriptor_.data(), n, descriptor_size_);
  out.id = id_;
  out.parent = parent_;
  out.uncertainty = Eigen::VectorXf::Map(uncertainty_.data(), n);
  return out;
}

Elites EliteStore::in_id_order() const {
  std::vector<std::int32_t> order(id_.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return id_[a] < id_[b]; });
  return in_order(in_slot_order(), order);
}

}  // namespace hbr::inline qd
