// Layers with the paper's settings, and stacks of their elites.
#pragma once

#include "pipeline/hierarchy/layers/arcs.h"
#include "pipeline/hierarchy/layers/digits.h"
#include "pipeline/hierarchy/layers/lines.h"
#include "pipeline/hierarchy/layers/points.h"
#include "pipeline/hierarchy/stack.h"
#include "tests/support/frame.h"

namespace hbr {

inline PointsSettings points_settings(const char* cost = "joint_variance") {
  return {kFrame.half_side, cost};
}
inline LinesSettings lines_settings(int samples, const char* range = "disc") {
  return {{kFrame.longest_line, range}, samples};
}
inline ArcsSettings arcs_settings(const char* controller, int samples,
                                  const ArcReadingSettings& reading = {"circle", "mean"}) {
  return {reading, controller, samples};
}
inline DigitsSettings digits_settings(double spacing, const char* out_of_range = "radius") {
  return {spacing, out_of_range, 0.05, {"box", 1, 4}};
}

inline Stack stack_of(const Robot& robot, const Elites& points) {
  Stack stack;
  stack.add(make_points(points_settings(), {robot}), points);
  return stack;
}
inline Stack stack_of(const Robot& robot, const Elites& points, const Elites& lines) {
  Stack stack = stack_of(robot, points);
  stack.add(make_lines(lines_settings(10), {robot, &stack}), lines);
  return stack;
}
inline Stack stack_of(const Robot& robot, const Elites& points, const Elites& lines, const Elites& arcs,
                      const char* controller = "turn") {
  Stack stack = stack_of(robot, points, lines);
  stack.add(make_arcs(arcs_settings(controller, 10), {robot, &stack}), arcs);
  return stack;
}

}  // namespace hbr
