// What a solution does and how well: genome -> descriptor and fitness. Knows nothing of the search.
#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/core/random.h"
#include "pipeline/qd/elites.h"

namespace hbr::inline qd {

// A generation of genomes and what their evaluation found, one row each.
struct Batch {
  Batch(int size, int genes, int descriptor_size)
      : genome(Rows::Zero(size, genes)),
        length(size, 0),
        valid(size, 0),
        descriptor(Rows::Zero(size, descriptor_size)),
        fitness(Eigen::VectorXf::Zero(size)),
        uncertainty(Eigen::VectorXf::Zero(size)) {}

  Eigen::Index size() const { return genome.rows(); }

  Rows genome;                       // [size x genes]
  std::vector<std::int32_t> length;  // [size]
  std::vector<std::uint8_t> valid;   // [size] 0: no behaviour to speak of, the rest of the row has no meaning
  Rows descriptor;                   // [size x d]
  Eigen::VectorXf fitness;           // [size]
  Eigen::VectorXf uncertainty;       // [size]
};

class Evaluator {
 public:
  virtual ~Evaluator() = default;
  virtual int descriptor_size() const = 0;
  // Whether the descriptor is stochastic and `uncertainty` means something.
  virtual bool stochastic() const { return false; }
  // Whether the same genome always has the same outcome, so that a copy of a solution need not be evaluated.
  virtual bool deterministic() const { return false; }
  // Fills rows [begin, end). A row depends on its genome and on seed.child(row) alone. Thread-safe.
  virtual void evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed seed) const = 0;
};

}  // namespace hbr::inline qd
