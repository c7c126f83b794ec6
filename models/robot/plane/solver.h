// How this library's small, dense least squares are solved.
#pragma once

#include <ceres/ceres.h>

namespace hbr::inline robots {

// Levenberg-Marquardt by QR, in silence, until the cost changes by less than the tolerance (relative).
inline ceres::Solver::Options dense_solver(int most_iterations, double tolerance) {
  ceres::Solver::Options options;
  options.max_num_iterations = most_iterations;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.function_tolerance = tolerance;
  return options;
}

}  // namespace hbr::inline robots
