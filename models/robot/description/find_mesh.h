// Where the mesh files that a URDF names are. Reads none of them as a mesh.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "models/robot/description/robot_model.h"

namespace hbr::inline robots {

struct FoundMesh {
  std::filesystem::path path;
  bool elsewhere = false;  // than where its name says
};

// The file behind a mesh's name in a URDF: below `folder` where one is given (the name's last parts, or a
// file of the same stem in another format), else beside the URDF (relative, file://, or package://NAME/...
// with a folder NAME somewhere above the URDF). Where it is not there, it may be elsewhere: by its last parts
// near the URDF, for packages are renamed and files moved, or one folder deeper than its name says. Throws
// InputError, naming what was tried, where there is none.
FoundMesh find_mesh(const std::string& name, const std::filesystem::path& urdf,
                    const std::filesystem::path& folder);

// Other files that a mesh names, if they are there: an OBJ its materials, a glTF its buffers. Throws
// InputError where a glTF does not tell.
std::vector<std::filesystem::path> named_by_mesh(const std::filesystem::path& mesh);

// All files that a robot's looks depend on: its meshes, found as above, and what they name themselves, each
// once, in the order of the links. What is missing, and what a mesh does not tell, is left out: whoever reads
// the mesh says so.
std::vector<std::filesystem::path> mesh_files(const RobotModel& model, const std::filesystem::path& folder);

}  // namespace hbr::inline robots
