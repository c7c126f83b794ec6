// How children differ from their parents, and what a random genome is.
#pragma once

#include "pipeline/core/random.h"

namespace hbr::inline qd {

class Variation {
 public:
  virtual ~Variation() = default;
  virtual int genes() const = 0;  // the longest genome's length
  virtual bool fixed_length() const = 0;
  // Both write at most genes() genes in [0, 1] and return the length.
  virtual int sample(float* genome, Rng& rng) const = 0;
  virtual int vary(const float* parent, int length, float* child, Rng& rng) const = 0;
};

// Which genes of a child mutate: each with a probability; the same, and one drawn at random where none did;
// or every one.
enum class MutatedGenes { kEach, kAtLeastOne, kEvery };
struct Mutation {
  float eta = 0;
  float rate = 0;  // the probability; kEvery has no use for it
  MutatedGenes genes = MutatedGenes::kEach;
};

// One gene's polynomial mutation (Deb and Goyal 1996): the distance has density (eta + 1)/2 (1 - |delta|)^eta
// on
// [-1, 1], the gene's whole range; the result is clipped to [0, 1].
float polynomial_step(float gene, float eta, float uniform);

// Genomes of a fixed length.
class PolynomialMutation final : public Variation {
 public:
  PolynomialMutation(int genes, Mutation mutation) : genes_(genes), mutation_(mutation) {}
  int genes() const override { return genes_; }
  bool fixed_length() const override { return true; }
  int sample(float* genome, Rng& rng) const override;
  int vary(const float* parent, int length, float* child, Rng& rng) const override;

 private:
  int genes_;
  Mutation mutation_;
};

// A head of `head` genes, then one to `most_blocks` blocks of `block` genes (paper, section 4.3: the digits'
// arcs). Besides the genes' mutation, with probability `length_rate` a random block enters or one leaves, at
// a random place, each as likely; nothing happens where the number of blocks allows no such step.
class BlockMutation final : public Variation {
 public:
  BlockMutation(int head, int block, int most_blocks, Mutation mutation, float length_rate)
      : head_(head),
        block_(block),
        most_blocks_(most_blocks),
        mutation_(mutation),
        length_rate_(length_rate) {}
  int genes() const override { return head_ + most_blocks_ * block_; }
  bool fixed_length() const override { return false; }
  int sample(float* genome, Rng& rng) const override;
  int vary(const float* parent, int length, float* child, Rng& rng) const override;

 private:
  int head_, block_, most_blocks_;
  Mutation mutation_;
  float length_rate_;
};

}  // namespace hbr::inline qd
