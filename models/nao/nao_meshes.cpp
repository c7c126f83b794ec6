#include "models/nao/nao_meshes.h"

#include "models/nao/nao_shells.h"
#include "models/robot/looks/mesh_file.h"
#include "pipeline/core/check.h"

namespace hbr::inline nao {

std::map<std::string, std::vector<Mesh>> nao_meshes() {
  std::map<std::string, std::vector<Mesh>> meshes = {
      {"Torso", nao_torso()},
      {"HeadYaw", nao_neck()},
      {"HeadPitch", nao_head()},
  };
  // The left side is the right one in the mirror, as in the robot.
  const auto both_sides = [&](const std::string& joint, const std::vector<Mesh>& left) {
    meshes["L" + joint] = left;
    for (const Mesh& mesh : left) meshes["R" + joint].push_back(mirrored(mesh));
  };
  both_sides("ShoulderPitch", nao_shoulder());
  both_sides("ShoulderRoll", nao_upper_arm());
  both_sides("ElbowYaw", nao_elbow());
  both_sides("ElbowRoll", nao_forearm());
  both_sides("WristYaw", nao_hand());
  both_sides("Hand", nao_fingers());
  both_sides("HipYawPitch", nao_pelvis());
  both_sides("HipRoll", nao_hip());
  both_sides("HipPitch", nao_thigh());
  both_sides("KneePitch", nao_shin());
  both_sides("AnklePitch", nao_ankle());
  both_sides("AnkleRoll", nao_foot());
  return meshes;
}

void write_nao_meshes(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw InputError("{}: can't be made: {}", folder.string(), error.message());
  for (const auto& [name, meshes] : nao_meshes())
    save_scene(folder / (name + ".obj"), "obj", {{name, meshes}});
}

}  // namespace hbr::inline nao
