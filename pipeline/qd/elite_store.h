// The elites that a repertoire holds now, in slots 0, 1, ... An elite that replaces another takes its slot.
#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/qd/elites.h"

namespace hbr::inline qd {

using Slot = std::int32_t;
inline constexpr Slot kNoSlot = -1;

// A solution that asks to be stored. The pointers are the caller's.
struct Candidate {
  const float* genome;       // [length] genes in [0, 1]
  int length;                // at most the store's genes
  const float* descriptor;   // [descriptor_size], finite
  float fitness;             // finite, larger is better
  float uncertainty;         // 0 where the layer has none
  std::int64_t id;           // greater than any id before
  std::int64_t parent = -1;  // id, or -1
};

class EliteStore {
 public:
  // genes: the longest genome's length.
  EliteStore(int genes, int descriptor_size) : genes_(genes), descriptor_size_(descriptor_size) {}

  Slot size() const { return static_cast<Slot>(id_.size()); }
  int genes() const { return genes_; }
  int descriptor_size() const { return descriptor_size_; }

  const float* genome(Slot s) const { return &genome_[static_cast<std::size_t>(s) * genes_]; }
  int length(Slot s) const { return length_[s]; }
  const float* descriptor(Slot s) const {
    return &descriptor_[static_cast<std::size_t>(s) * descriptor_size_];
  }
  float fitness(Slot s) const { return fitness_[s]; }
  float uncertainty(Slot s) const { return uncertainty_[s]; }
  std::int64_t id(Slot s) const { return id_[s]; }

  Slot append(const Candidate& candidate);
  void replace(Slot slot, const Candidate& candidate);

  // The elites in slot order (a checkpoint) or in id order (a finished repertoire).
  Elites in_slot_order() const;
  Elites in_id_order() const;

 private:
  int genes_, descriptor_size_;
  std::vector<float> genome_, descriptor_, fitness_, uncertainty_;
  std::vector<std::int32_t> length_;
  std::vector<std::int64_t> id_, parent_;
};

}  // namespace hbr::inline qd
