#include "models/robot/looks/boards.h"

#include "models/robot/looks/shapes.h"

namespace hbr::inline robots {

Posed framed_board(const std::string& name, const Board& board, const Eigen::Vector3f& colour) {
  const double half = board.plane.scale * board.half_side, rail = half / 60;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear().col(0) = board.plane.u;
  pose.linear().col(1) = board.plane.v;
  pose.linear().col(2) = board.plane.normal();
  pose.translation() = board.plane.origin;
  Posed framed{name, {coloured(rounded_box({2 * half, 2 * half, rail}, rail / 4), colour)}, pose};
  framed.meshes[0].opacity = 0.2f;
  for (const double side : {-1., 1.}) {
    framed.meshes.push_back(coloured(rod({-half, side * half, 0}, {half, side * half, 0}, rail), colour));
    framed.meshes.push_back(coloured(rod({side * half, -half, 0}, {side * half, half, 0}, rail), colour));
  }
  return framed;
}

}  // namespace hbr::inline robots
