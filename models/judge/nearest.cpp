#include "models/judge/nearest.h"

#include <algorithm>
#include <utility>

#include "pipeline/core/check.h"

namespace hbr::inline judge {
namespace {

// Fixed, so that the products' rounding does not depend on who computes them.
constexpr Eigen::Index kQueries = 128, kTable = 1024;

}  // namespace

std::vector<std::int32_t> nearest_rows(const Rows& table, const Rows& queries, int k, Workers& workers) {
  HBR_CHECK(k >= 1 && k <= table.rows(), "k = {}, rows = {}", k, table.rows());
  const Eigen::Index n = queries.rows(), m = table.rows();
  const Eigen::VectorXf half_norms = 0.5f * table.rowwise().squaredNorm();
  std::vector<std::int32_t> nearest(n * k);
  workers.for_each((n + kQueries - 1) / kQueries, [&](std::size_t block) {
    const Eigen::Index begin = block * kQueries, count = std::min(kQueries, n - begin);
    // Per query a heap of the k best so far, the worst on top. |q - t|^2 orders as |t|^2 / 2 - q t.
    std::vector<std::vector<std::pair<float, std::int32_t>>> best(count);
    Rows score;
    for (Eigen::Index from = 0; from < m; from += kTable) {
      const Eigen::Index rows = std::min(kTable, m - from);
      score.noalias() = -queries.middleRows(begin, count) * table.middleRows(from, rows).transpose();
      score.rowwise() += half_norms.segment(from, rows).transpose();
      for (Eigen::Index q = 0; q < count; ++q) {
        auto& heap = best[q];
        for (Eigen::Index t = 0; t < rows; ++t) {
          const std::pair<float, std::int32_t> candidate(score(q, t), static_cast<std::int32_t>(from + t));
          if (static_cast<int>(heap.size()) == k) {
            if (!(candidate < heap.front())) continue;
            std::pop_heap(heap.begin(), heap.end());
            heap.pop_back();
          }
          heap.push_back(candidate);
          std::push_heap(heap.begin(), heap.end());
        }
      }
    }
    for (Eigen::Index q = 0; q < count; ++q) {
      std::sort_heap(best[q].begin(), best[q].end());
      for (int i = 0; i < k; ++i) nearest[(begin + q) * k + i] = best[q][i].second;
    }
  });
  return nearest;
}

}  // namespace hbr::inline judge
