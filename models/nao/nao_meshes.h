// NAO's shells, made from rounded primitives that fit its joints' offsets and its height of 574 mm: white and
// grey-blue, with a face. Our own shapes; none are the maker's.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "models/robot/looks/mesh.h"

namespace hbr::inline nao {

// By the name of the mesh in nao.urdf ("Torso", else the joint that moves it), in the link's frame.
std::map<std::string, std::vector<Mesh>> nao_meshes();

// Writes them as NAME.obj with NAME.mtl into `folder`, which is made. Throws InputError where it can't.
void write_nao_meshes(const std::filesystem::path& folder);

}  // namespace hbr::inline nao
