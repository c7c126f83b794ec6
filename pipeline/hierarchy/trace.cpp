#include "pipeline/hierarchy/trace.h"

namespace hbr::inline hierarchy {
namespace {

Executions executed(const Executor& executor, const float* genome, int length) {
  const Rows row = Eigen::Map<const Rows>(genome, 1, length);
  Executions executions;
  std::uint8_t possible = 0;
  executor.execute(row, nullptr, 0, 1, Seed(0), executions, &possible);
  return executions;
}

}  // namespace

Trace trace_of(const Executions& executions, int execution) {
  const PointLayer& points = executions.points();
  Trace trace;
  for (const std::int32_t elite : executions.way(execution)) {
    const Eigen::Vector2d p = points.position(elite);
    trace.pen.insert(trace.pen.end(), {static_cast<float>(p.x()), static_cast<float>(p.y())});
    trace.joints.insert(trace.joints.end(), points.joints(elite), points.joints(elite) + points.dof());
  }
  return trace;
}

Trace trace_of(const Executor& executor, const float* genome, int length) {
  return trace_of(executed(executor, genome, length), 0);
}

std::vector<std::int32_t> way_of(const Executor& executor, const float* genome, int length) {
  return executed(executor, genome, length).way(0);
}

}  // namespace hbr::inline hierarchy
