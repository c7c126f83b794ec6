#include "stages/plan/robot_inputs.h"

#include <algorithm>

#include "models/robot/description/find_mesh.h"

namespace hbr::inline stages {
namespace {

const std::string kNaoMeshes = "nao_meshes";

}  // namespace

void append(Inputs& inputs, const Inputs& more) { inputs.insert(inputs.end(), more.begin(), more.end()); }

std::vector<const LayerRow*> transferred(const Plan& plan) {
  return plan.stack(plan.profile().digits.hierarchy);
}

Inputs over(const Plan& plan, const std::string& name, const std::vector<const LayerRow*>& stack,
            const RobotSettings* robot, int replication) {
  Inputs inputs = plan.inputs(name, stack, replication);
  if (robot) inputs.front().second = numbered(robot->name + "_projected", replication);
  return inputs;
}

Inputs plane(const RobotSettings* robot) {
  return robot ? Inputs{{"plane", robot->name + "_plane.h5"}} : Inputs{};
}

Inputs meshes_of(Plan& plan, const RobotSettings& robot) {
  if (robot.meshes != kNaoMeshes) return {};
  if (std::ranges::find(plan.graph(), kNaoMeshes, &Node::stage) == plan.graph().end())
    plan.add({kNaoMeshes, kNaoMeshes, -1, kNaoMeshes, nlohmann::json::object(), {}, {}});
  return {{"meshes", kNaoMeshes}};
}

std::vector<std::string> looks_of(const RobotSettings& robot) {
  std::vector<std::string> sources{robot.urdf};
  if (robot.meshes == kNaoMeshes) return sources;
  try {
    for (const std::filesystem::path& mesh : mesh_files(load_urdf(robot.urdf), robot.meshes))
      sources.push_back(mesh.string());
  } catch (const InputError&) {
  }
  return sources;
}

}  // namespace hbr::inline stages
