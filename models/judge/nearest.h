// The nearest rows of a table by Euclidean distance, by comparing with all of them.
#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/core/parallel.h"
#include "pipeline/qd/elites.h"

namespace hbr::inline judge {

// For each query [n x d] the indices [n x k] of its k nearest rows of `table` [m x d], the nearest first, the
// lower index first among equals. 1 <= k <= m. The same for any number of workers.
std::vector<std::int32_t> nearest_rows(const Rows& table, const Rows& queries, int k, Workers& workers);

}  // namespace hbr::inline judge
