#include "models/robot/looks/camera.h"

#include <algorithm>
#include <cmath>

#include "models/robot/looks/triangles.h"

namespace hbr::inline robots {

Camera camera_for(const Scene& scene, const Eigen::Vector3d& direction, double view_rad, double aspect) {
  const std::vector<Triangle> solid = triangles_of(scene.bodies, true);
  const Eigen::Matrix3d seen = axes_along(direction.normalized().cast<float>()).cast<double>();
  constexpr double kMargin = 0.94;
  const double up = kMargin * std::tan(view_rad / 2), side = up * aspect;
  // In the camera's axes: the four planes that hold everything, then the eye where the tighter pair meets.
  double left = -1e9, right = -1e9, top = -1e9, bottom = -1e9;
  for (const Triangle& t : solid)
    for (const Eigen::Vector3f& corner : t.corner) {
      const Eigen::Vector3d q = seen * corner.cast<double>();
      left = std::max(left, -q[0] - side * q[2]);
      right = std::max(right, q[0] - side * q[2]);
      top = std::max(top, -q[1] - up * q[2]);
      bottom = std::max(bottom, q[1] - up * q[2]);
    }
  const Eigen::Vector3d at((right - left) / 2, (bottom - top) / 2,
                           -std::max((right + left) / (2 * side), (bottom + top) / (2 * up)));
  const Eigen::Vector3d eye = seen.transpose() * at;
  return {eye, eye + direction.normalized(), view_rad};
}

}  // namespace hbr::inline robots
