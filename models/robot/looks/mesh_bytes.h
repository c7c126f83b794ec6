// Meshes as bytes, from the process that reads them to the one that asked for them.
#pragma once

#include <string>
#include <vector>

#include "models/robot/looks/mesh.h"

namespace hbr::inline robots {

std::string packed(const std::vector<Mesh>& meshes);

// A reader that a damaged file led astray may say anything: throws InputError, with `what` before the words,
// where the bytes are no meshes, or a triangle names a vertex that is not there.
std::vector<Mesh> unpacked(const std::string& what, const std::string& bytes);

}  // namespace hbr::inline robots
