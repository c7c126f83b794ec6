#pragma once

#include <vector>

#include "models/robot/looks/mesh.h"

namespace hbr {

// Of closed surfaces whose triangles turn to the left seen from outside.
inline double volume(const std::vector<Mesh>& meshes) {
  double sum = 0;
  for (const Mesh& mesh : meshes)
    for (const Eigen::Vector3i& t : mesh.triangles)
      sum += mesh.vertices[t[0]].cast<double>().dot(
                 mesh.vertices[t[1]].cast<double>().cross(mesh.vertices[t[2]].cast<double>())) /
             6;
  return sum;
}

}  // namespace hbr
