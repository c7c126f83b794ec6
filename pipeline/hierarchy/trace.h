// What an execution drew.
#pragma once

#include <vector>

#include "pipeline/hierarchy/executor.h"

namespace hbr::inline hierarchy {

// The pen's positions [n x 2] in metres, x and y in turn, and the configurations that led through them, [n x
// dof] in radians.
struct Trace {
  std::vector<float> pen;
  std::vector<double> joints;
  Eigen::Index points() const { return static_cast<Eigen::Index>(pen.size() / 2); }
};
// Of an execution whose way was kept.
Trace trace_of(const Executions& executions, int execution);
// Of a genome that places the pen itself; empty where it asks for what can't be.
Trace trace_of(const Executor& executor, const float* genome, int length);
// The elites of layer 1 that it passes.
std::vector<std::int32_t> way_of(const Executor& executor, const float* genome, int length);

}  // namespace hbr::inline hierarchy
