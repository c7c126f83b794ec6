// NAO's right arm, as a profile's table names it.
#pragma once

#include <string>
#include <vector>

#include "models/robot/plane/robot_settings.h"

namespace hbr {

inline const std::string kUrdf = HBR_SOURCE_DIR "/models/nao/nao.urdf";
inline const std::vector<std::string> kRightArm = {"RShoulderPitch", "RShoulderRoll", "RElbowYaw",
                                                   "RElbowRoll"};

inline RobotSettings nao_right_arm() {
  RobotSettings s;
  s.name = "nao";
  s.urdf = kUrdf;
  s.tip_link = "r_gripper";
  s.joints = kRightArm;
  return s;
}

}  // namespace hbr
