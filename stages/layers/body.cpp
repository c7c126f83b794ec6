#include "stages/layers/body.h"

#include "models/arm/planar_arm.h"
#include "models/robot/plane/plane_file.h"
#include "pipeline/core/check.h"

namespace hbr::inline stages {

std::unique_ptr<Robot> make_body(const nlohmann::json& body, const std::string& where,
                                 const StageRun& stage) {
  if (body.contains("arm")) {
    const auto arm = settings_from_json<ArmTable>(body["arm"], where + ": body.arm");
    return std::make_unique<PlanarArm>(arm.links, arm.joint_limit);
  }
  if (!body.contains("robot"))
    throw InputError("{}: body is neither an arm nor a robot; expected one of the two", where);
  const auto robot = settings_from_json<RobotSettings>(body["robot"], where + ": body.robot");
  return std::make_unique<RobotOnPlane>(make_robot(robot, load_plane(stage.input("plane"))));
}

const RobotOnPlane& on_plane(const Robot& body) {
  const auto* robot = dynamic_cast<const RobotOnPlane*>(&body);
  if (!robot) throw InputError("the body is '{}'; expected a robot on a plane", body.name());
  return *robot;
}

}  // namespace hbr::inline stages
