// Random numbers as a pure function of names and indices, so that order, threads and time cannot change them.
//
// A Seed is a node of a tree: the master seed is the root, every name or index leads to a child. An Rng is
// the stream of one node (Philox 4x32-10, Salmon et al. 2011, from Random123: the key is the node, the
// counter the draw).
//
//   const Seed layer = Seed(profile.seed).child("layer1").child(replication);
//   Rng rng(layer.child("offspring").child(generation).child(index));
//   float gene = rng.uniform();
#pragma once

#include <Random123/philox.h>

#include <array>
#include <cstdint>
#include <string_view>

namespace hbr::inline core {

class Seed {
 public:
  explicit Seed(std::uint64_t master) : key_(master) {}
  Seed child(std::string_view name) const;
  Seed child(std::uint64_t index) const;
  std::uint64_t key() const { return key_; }

 private:
  std::uint64_t key_;
};

class Rng {
 public:
  explicit Rng(Seed seed);

  std::uint32_t bits() {
    if (used_ == block_.size()) refill();
    return block_[used_++];
  }
  // Uniform in [0, 1), a multiple of 2^-24: exact in a float.
  float uniform() { return static_cast<float>(bits() >> 8) * 0x1p-24f; }
  // Uniform in [low, high]: the sum may be rounded to its upper end.
  float uniform(float low, float high) { return low + (high - low) * uniform(); }
  // Uniform in [0, 1), a multiple of 2^-53.
  double uniform_double();
  // Uniform in {0, ..., n - 1}; n > 0. Unbiased (Lemire 2019).
  std::uint32_t below(std::uint32_t n);

 private:
  void refill();

  r123::Philox4x32::key_type key_;
  std::uint64_t counter_ = 0;
  r123::Philox4x32::ctr_type block_{};
  std::size_t used_ = 4;
};

}  // namespace hbr::inline core
