// What only the page shows: the arm and the robots in three dimensions, drawing their digits.
#include <algorithm>

#include "stages/plan/robot_inputs.h"

namespace hbr::inline stages {
namespace {

// With none, the arm.
void plan_robot(Plan& plan, const RobotSettings* robot) {
  const Profile& p = plan.profile();
  const auto stack = transferred(plan);
  const std::string name = robot ? robot->name : "arm";
  Inputs looks = plane(robot);
  if (robot) append(looks, meshes_of(plan, *robot));
  plan.add("robot_shape", name + "_shape", -1,
           {{"half_side", stack.front()->settings["half_side"]},
            {"shape", settings_to_json(p.robot_shape)},
            {"body", robot ? nlohmann::json{{"robot", settings_to_json(*robot)}} : plan.arm()}},
           looks, robot ? looks_of(*robot) : std::vector<std::string>{});
  if (!robot) return;  // the explorer has its ways
  for (int r = 0; r < std::min(p.replications.digits, p.explorer.replications); ++r) {
    Inputs drawn = over(plan, "layer", stack, robot, r);
    append(drawn, plane(robot));
    drawn.emplace_back("digits", numbered("digit_verdicts", r));
    plan.add("robot_ways", name + "_ways", r, nlohmann::json::object(), drawn, {robot->urdf});
  }
}

}  // namespace

void plan_shown_robots(Plan& plan) {
  const Profile& p = plan.profile();
  if (std::min(p.replications.digits, p.explorer.replications) == 0 || p.digits.hierarchy.empty()) return;
  plan_robot(plan, nullptr);
  for (const RobotSettings& robot : p.robots) plan_robot(plan, &robot);
}

}  // namespace hbr::inline stages
