// Colours and placing of NAO's shells.
#pragma once

#include "models/robot/looks/shapes.h"

namespace hbr::inline nao {

inline const Eigen::Vector3f kWhite(0.93f, 0.94f, 0.95f);
inline const Eigen::Vector3f kAccent(0.27f, 0.43f, 0.62f);  // grey-blue
inline const Eigen::Vector3f kJoint(0.42f, 0.45f, 0.49f);   // what shows between the shells
inline const Eigen::Vector3f kDark(0.08f, 0.09f, 0.11f);
inline const Eigen::Vector3f kEye(0.55f, 0.86f, 0.98f);

inline Mesh white(Mesh mesh) { return coloured(std::move(mesh), kWhite); }
inline Mesh accent(Mesh mesh) { return coloured(std::move(mesh), kAccent); }
inline Mesh joint(Mesh mesh) { return coloured(std::move(mesh), kJoint); }
inline Mesh dark(Mesh mesh) { return coloured(std::move(mesh), kDark); }

inline Mesh at(double x, double y, double z, Mesh mesh) {
  return moved(std::move(mesh), Eigen::Isometry3d(Eigen::Translation3d(x, y, z)));
}
// The mesh's z axis turned to that direction; its x axis stays as near as it can.
inline Mesh facing(const Eigen::Vector3d& direction, Mesh mesh) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.rotate(Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), direction));
  return moved(std::move(mesh), pose);
}
// The mesh's z becomes x, its x becomes y, its y becomes z: sections of limbs that lie along x.
inline Mesh along_x(Mesh mesh) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  return moved(std::move(mesh), pose);
}
inline Mesh along_y(Mesh mesh) { return facing(Eigen::Vector3d::UnitY(), std::move(mesh)); }

}  // namespace hbr::inline nao
