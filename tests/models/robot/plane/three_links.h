// Three links of 1 m in the plane x = 0 which turn all round: one joint to spare. A metre of the arm is one
// of theirs.
#pragma once

#include "models/robot/plane/robot_on_plane.h"
#include "pipeline/hierarchy/frame.h"
#include "tests/models/robot/body/chains.h"

namespace hbr {

inline constexpr double kTolerance = 0.01;
inline const Frame kFrame{3, 0};

// On the robot's side of the plane, and next to nothing.
inline const std::string kBeside =
    R"(<visual><origin xyz="-0.1 0.2 0.3"/><geometry><sphere radius="0.0001"/></geometry></visual>)";

inline const RobotOnPlane& three_links() {
  static const RobotOnPlane robot("three", chain({Turn{}, Turn{}, Turn{}}, "1 0 0", kBeside), "tip",
                                  DrawingPlane::facing({0, 0, 0}, 0, 0, 1), kTolerance);
  return robot;
}

}  // namespace hbr
