// The shells of NAO's links, left side, each in its link's frame (m; x forward, y left, z up at rest, the
// arms stretched forward).
#pragma once

#include <vector>

#include "models/robot/looks/mesh.h"

namespace hbr::inline nao {

std::vector<Mesh> nao_torso();
std::vector<Mesh> nao_neck();
std::vector<Mesh> nao_head();

std::vector<Mesh> nao_shoulder();
std::vector<Mesh> nao_upper_arm();
std::vector<Mesh> nao_elbow();
std::vector<Mesh> nao_forearm();
std::vector<Mesh> nao_hand();
std::vector<Mesh> nao_fingers();

std::vector<Mesh> nao_pelvis();
std::vector<Mesh> nao_hip();
std::vector<Mesh> nao_thigh();
std::vector<Mesh> nao_shin();
std::vector<Mesh> nao_ankle();
std::vector<Mesh> nao_foot();

}  // namespace hbr::inline nao
