// Where a robot's shapes are, and with them what it stands on.
#pragma once

#include <vector>

#include "models/robot/body/body.h"
#include "models/robot/looks/mesh.h"

namespace hbr::inline robots {

// The corners of every link's shapes (meshes by link, visible_links.h) at these joints [dof], m, in the frame
// that Body's places have.
std::vector<Eigen::Vector3d> shape_corners(const Body& body, const std::vector<std::vector<Mesh>>& meshes,
                                           const Eigen::VectorXd& joints);

}  // namespace hbr::inline robots
