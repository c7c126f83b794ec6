#include "pipeline/statistics/curves.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace hbr::inline statistics {
namespace {

std::vector<double> shared_points(const std::vector<Course>& replications) {
  std::vector<double> shared;
  for (std::size_t r = 0; r < replications.size(); ++r) {
    std::vector<double> points, both;
    for (const auto& [at, value] : replications[r]) points.push_back(at);
    if (r > 0) std::ranges::set_intersection(shared, points, std::back_inserter(both));
    shared = r > 0 ? both : points;
  }
  return shared;
}

std::vector<double> thinned(const std::vector<double>& points) {
  if (points.size() <= kCurvePoints) return points;
  std::vector<double> kept;
  const double step = static_cast<double>(points.size() - 1) / (kCurvePoints - 1);
  for (std::size_t i = 0; i < kCurvePoints; ++i)
    kept.push_back(points[static_cast<std::size_t>(std::lround(step * static_cast<double>(i)))]);
  return kept;
}

}  // namespace

void add_curve(StatisticsTable& table, const std::string& name, const std::string& x,
               const std::string& measure, const std::vector<Course>& replications) {
  const std::vector<double> at = thinned(shared_points(replications));
  if (at.empty()) return;
  std::vector<std::vector<double>> rows;
  for (const Course& course : replications) {
    std::vector<double> row;
    for (const double point : at)
      row.push_back(std::ranges::lower_bound(course, point, {}, &Course::value_type::first)->second);
    rows.push_back(row);
  }
  table.curve(name, x, at, measure, rows);
}

}  // namespace hbr::inline statistics
