#include "stages/tuning.h"

#include "models/simbody/plane_file.h"
#include "models/simbody/robot_on_plane.h"

namespace hbr {

std::unique_ptr<Robot> make_drawer(const StageRun& stage, const Drawer& drawer, const ArmTable& arm) {
  if (drawer.robot.empty()) return std::make_unique<PlanarArm>(make_arm(arm));
  return std::make_unique<RobotOnPlane>(make_robot(drawer.robot.front(), load_plane(stage.input("plane"))));
}

}  // namespace hbr
