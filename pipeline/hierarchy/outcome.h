// What executions came to: their descriptors and their fitness.
#pragma once

#include "pipeline/hierarchy/executions.h"

namespace hbr::inline hierarchy {

class Outcome {
 public:
  virtual ~Outcome() = default;
  virtual int descriptor_size() const = 0;
  // Range of the descriptor, the same in every dimension.
  virtual float low() const { return 0; }
  virtual float high() const { return 1; }
  // How much of the executions' ways is looked at.
  virtual Way way() const { return {}; }
  // Writes the descriptors [size x descriptor_size], row-major, and the fitness [size], larger being better,
  // of all executions. Thread-safe.
  virtual void measure(const Executions& executions, float* descriptor, float* fitness) const = 0;
};

// An outcome of which there may be many samples: the fitness is asked of one of them.
class SampledOutcome : public Outcome {
 public:
  // Writes coordinate d of execution first + i to descriptor[d][i], for i < n. Thread-safe, as is fitness().
  virtual void describe(const Executions& executions, int first, int n, float* const* descriptor) const = 0;
  virtual double fitness(const Executions& executions, int execution) const = 0;
  // One by one.
  void measure(const Executions& executions, float* descriptor, float* fitness) const final;
};

}  // namespace hbr::inline hierarchy
