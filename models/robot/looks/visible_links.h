// Every link as something to look at, whatever its description shows.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "models/robot/looks/mesh_file.h"

namespace hbr::inline robots {

// What each link looks like, in its frame. Where meshes can't be had `odd` says so, of the first one why;
// such a link, and every link of a robot that shows nothing at all, is drawn as rods between its joints.
std::vector<std::vector<Mesh>> visible_links(const RobotModel& model, const std::filesystem::path& folder,
                                             double scale, std::vector<std::string>& odd);

}  // namespace hbr::inline robots
