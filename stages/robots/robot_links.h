// What a profile's robot looks like.
#pragma once

#include <fmt/core.h>

#include <cstdio>

#include "models/robot/looks/visible_links.h"
#include "models/robot/plane/robot_settings.h"
#include "pipeline/artifact/stage.h"

namespace hbr::inline stages {

// Each link in its frame. A mesh that can't be had stops no run: what is drawn in its place is told on the
// terminal.
inline std::vector<std::vector<Mesh>> robot_links(const StageRun& stage, const RobotModel& model,
                                                  const RobotSettings& robot) {
  const auto folder = stage.has_input("meshes") ? stage.input("meshes") : std::filesystem::path(robot.meshes);
  std::vector<std::string> odd;
  std::vector<std::vector<Mesh>> links = visible_links(model, folder, robot.mesh_scale, odd);
  for (const std::string& line : odd) fmt::print(stderr, "{}: {}\n", robot.name, line);
  return links;
}

}  // namespace hbr::inline stages
