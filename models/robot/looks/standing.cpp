#include "models/robot/looks/standing.h"

namespace hbr::inline robots {

std::vector<Eigen::Vector3d> shape_corners(const Body& body, const std::vector<std::vector<Mesh>>& meshes,
                                           const Eigen::VectorXd& joints) {
  const std::vector<Eigen::Isometry3d> poses = body.link_poses(joints);
  std::vector<Eigen::Vector3d> corners;
  for (std::size_t link = 0; link < poses.size(); ++link)
    for (const Mesh& mesh : meshes.at(link))
      for (const Eigen::Vector3f& vertex : mesh.vertices)
        corners.emplace_back(poses[link] * vertex.cast<double>());
  return corners;
}

}  // namespace hbr::inline robots
