#include "pipeline/qd/elites.h"

namespace hbr::inline qd {
namespace {

template <class T>
std::vector<T> in_order(const std::vector<T>& values, const std::vector<std::int32_t>& order) {
  std::vector<T> out;
  if (values.empty()) return out;
  out.reserve(order.size());
  for (const std::int32_t i : order) out.push_back(values[i]);
  return out;
}

}  // namespace

Elites in_order(const Elites& e, const std::vector<std::int32_t>& order) {
  Elites out;
  out.solution = e.solution(order, Eigen::all);
  out.length = in_order(e.length, order);
  out.objective = e.objective(order);
  out.measures = e.measures(order, Eigen::all);
  out.id = in_order(e.id, order);
  out.parent = in_order(e.parent, order);
  if (e.uncertainty.size()) out.uncertainty = e.uncertainty(order);
  return out;
}

}  // namespace hbr::inline qd
