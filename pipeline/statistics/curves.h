// The course of something over replications: median and quartiles where all replications have a value.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "pipeline/statistics/table.h"

namespace hbr::inline statistics {

using Course = std::vector<std::pair<double, double>>;  // (at, value), ascending

// At most this many points a curve, evenly among those that all replications share, first and last kept.
inline constexpr std::size_t kCurvePoints = 200;

// Nothing is added where the replications share no point.
void add_curve(StatisticsTable& table, const std::string& name, const std::string& x,
               const std::string& measure, const std::vector<Course>& replications);

}  // namespace hbr::inline statistics
