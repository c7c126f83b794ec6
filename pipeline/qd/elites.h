// The elites of a repertoire as plain arrays: what a finished layer hands to the next, and what its file
// holds.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace hbr::inline qd {

// One row per elite, row-major like the arrays in a file.
using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct Elites {
  Rows solution;                     // [n x genes], in [0, 1]; past an elite's length, 0
  std::vector<std::int32_t> length;  // [n] genes in use; empty where all genomes have the same length
  Eigen::VectorXf objective;         // [n] fitness, larger is better
  Rows measures;                     // [n x d] descriptor
  std::vector<std::int64_t> id;      // [n] ascending: the order in which elites were born
  std::vector<std::int64_t> parent;  // [n] id of the parent, -1 for an elite drawn at random
  Eigen::VectorXf uncertainty;  // [n] mean distance of the samples to the stochastic descriptor, or empty

  Eigen::Index size() const { return measures.rows(); }
  // Genes in use by elite i.
  int genes(Eigen::Index i) const { return length.empty() ? static_cast<int>(solution.cols()) : length[i]; }
};

// Rows order[0], order[1], ... of `elites`.
Elites in_order(const Elites& elites, const std::vector<std::int32_t>& order);

// The course of a search: one entry per recorded generation.
struct ProgressRow {
  std::int64_t generation;
  std::int64_t size;         // elites in the repertoire
  double best;               // highest fitness
  double mean;               // mean fitness
  std::int64_t evaluations;  // so far
};

}  // namespace hbr::inline qd
