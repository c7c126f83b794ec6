// NAO's right arm, as a profile's table names it.
#pragma once

#include "models/simbody/robot_settings.h"

namespace hbr {

inline RobotSettings nao_right_arm() {
  RobotSettings s;
  s.name = "nao";
  s.urdf = HBR_SOURCE_DIR "/models/nao/nao.urdf";
  s.tip_link = "r_gripper";
  s.joints = {"RShoulderPitch", "RShoulderRoll", "RElbowYaw", "RElbowRoll"};
  return s;
}

}  // namespace hbr
