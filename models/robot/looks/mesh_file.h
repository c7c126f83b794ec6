// Meshes of links from files (assimp: OBJ, STL, DAE, glTF and more) and back.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "models/robot/description/robot_model.h"
#include "models/robot/looks/mesh.h"

namespace hbr::inline robots {

// All triangles of a file, one mesh for each of its materials, multiplied by `scale`; what has no material of
// its own is `uncoloured`. The axes of a glTF and of a DAE stay as they are; a DAE's <unit> counts. Throws
// InputError for a file that can't be read or holds no triangle.
std::vector<Mesh> load_meshes(const std::filesystem::path& path, const Eigen::Vector3d& scale = {1, 1, 1},
                              const Eigen::Vector3f& uncoloured = Mesh().colour);

// What a link looks like, in its own frame; files are found as above and multiplied by `scale`.
std::vector<Mesh> visual_meshes(const RobotModel& model, const Link& link,
                                const std::filesystem::path& folder, double scale);
// Of every link.
std::vector<std::vector<Mesh>> link_meshes(const RobotModel& model, const std::filesystem::path& folder,
                                           double scale);

// A body of a scene: meshes in its frame, and the frame's pose.
struct Posed {
  std::string name;
  std::vector<Mesh> meshes;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
};

// Writes a scene; `format` is assimp's: "obj" (with its .mtl beside it), "glb2", ... A glTF is turned so that
// y is up, as its viewers expect. Throws InputError where that fails.
void save_scene(const std::filesystem::path& path, const std::string& format,
                const std::vector<Posed>& bodies);

}  // namespace hbr::inline robots
