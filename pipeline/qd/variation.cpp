#include "pipeline/qd/variation.h"

#include <algorithm>
#include <cmath>

namespace hbr::inline qd {
namespace {

void sample_genes(float* genes, int n, Rng& rng) {
  for (int i = 0; i < n; ++i) genes[i] = rng.uniform();
}

void mutate_genes(const float* parent, int n, const Mutation& mutation, float* child, Rng& rng) {
  const bool every = mutation.genes == MutatedGenes::kEvery;
  bool any = false;
  for (int i = 0; i < n; ++i) {
    const bool mutates = every || rng.uniform() < mutation.rate;
    child[i] = mutates ? polynomial_step(parent[i], mutation.eta, rng.uniform()) : parent[i];
    any = any || mutates;
  }
  if (any || mutation.genes != MutatedGenes::kAtLeastOne) return;
  const auto one = rng.below(static_cast<std::uint32_t>(n));
  child[one] = polynomial_step(parent[one], mutation.eta, rng.uniform());
}

}  // namespace

float polynomial_step(float gene, float eta, float uniform) {
  const float exponent = 1 / (eta + 1);
  const float delta =
      uniform < 0.5f ? std::pow(2 * uniform, exponent) - 1 : 1 - std::pow(2 * (1 - uniform), exponent);
  return std::clamp(gene + delta, 0.0f, 1.0f);
}

int PolynomialMutation::sample(float* genome, Rng& rng) const {
  sample_genes(genome, genes_, rng);
  return genes_;
}

int PolynomialMutation::vary(const float* parent, int length, float* child, Rng& rng) const {
  mutate_genes(parent, length, mutation_, child, rng);
  return length;
}

int BlockMutation::sample(float* genome, Rng& rng) const {
  const int blocks = 1 + static_cast<int>(rng.below(most_blocks_));
  sample_genes(genome, head_ + blocks * block_, rng);
  return head_ + blocks * block_;
}

int BlockMutation::vary(const float* parent, int length, float* child, Rng& rng) const {
  mutate_genes(parent, length, mutation_, child, rng);
  if (rng.uniform() >= length_rate_) return length;
  const int blocks = (length - head_) / block_;
  if (rng.uniform() < 0.5f) {
    if (blocks == most_blocks_) return length;
    float* at = child + head_ + block_ * static_cast<int>(rng.below(blocks + 1));
    std::copy_backward(at, child + length, child + length + block_);
    sample_genes(at, block_, rng);
    return length + block_;
  }
  if (blocks == 1) return length;
  float* at = child + head_ + block_ * static_cast<int>(rng.below(blocks));
  std::copy(at + block_, child + length, at);
  return length - block_;
}

}  // namespace hbr::inline qd
