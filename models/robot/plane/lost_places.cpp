#include "models/robot/plane/lost_places.h"

namespace hbr::inline robots {
namespace {

constexpr int kStarts = 8;  // of inverse kinematics

Lack lack_at(const RobotOnPlane& robot, const PointLayer& points, const Reach& reach,
             const Eigen::Vector2d& place, double l) {
  if ((points.position(points.nearest(place)) - place).norm() <= l) return Lack::none;
  const Eigen::Vector3d target = robot.plane().to_robot(place);
  const double enough = robot.off_plane_tolerance();
  if (reach.nearest(target, {robot.plane(), points.frame().half_side}, kStarts, enough).gap.norm() <= enough)
    return Lack::gap;
  return reach.nearest_of_any(target, kStarts, enough).gap.norm() <= enough ? Lack::collision : Lack::limit;
}

}  // namespace

Lacks lacks_along(const RobotOnPlane& robot, const PointLayer& points, const Reach& reach,
                  const std::vector<Eigen::Vector2d>& places, double l) {
  Lacks lacks{};
  for (const Eigen::Vector2d& place : places)
    ++lacks[static_cast<std::size_t>(lack_at(robot, points, reach, place, l))];
  return lacks;
}

}  // namespace hbr::inline robots
