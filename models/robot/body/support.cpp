#include "models/robot/body/support.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipeline/core/check.h"

namespace hbr::inline robots {
namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// Counter-clockwise (A. M. Andrew's monotone chain, 1979); fewer than three where all lie on a line.
std::vector<Eigen::Vector2d> convex_hull(std::vector<Eigen::Vector2d> points) {
  const auto before = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  };
  std::ranges::sort(points, before);
  std::vector<Eigen::Vector2d> hull;
  for (int side = 0; side < 2; ++side) {  // from left to right below, back above
    const std::size_t start = hull.size();
    for (const Eigen::Vector2d& p : points) {
      while (hull.size() >= start + 2 && cross(hull.back() - hull.end()[-2], p - hull.back()) <= 0)
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();  // the other side begins with it
    std::ranges::reverse(points);
  }
  return hull;
}

}  // namespace

Support::Support(const std::vector<Eigen::Vector3d>& places, double touching) {
  floor_ = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& p : places) floor_ = std::min(floor_, p.z());
  std::vector<Eigen::Vector2d> touch;
  for (const Eigen::Vector3d& p : places)
    if (p.z() <= floor_ + touching) touch.emplace_back(p.head<2>());
  if (!touch.empty()) corners_ = convex_hull(std::move(touch));
  if (corners_.size() < 3)
    throw InputError("what touches the floor has {} corners; expected a sole of three or more",
                     corners_.size());
}

double Support::margin(const Eigen::Vector2d& place) const {
  double inside = std::numeric_limits<double>::infinity(), nearest = inside;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Eigen::Vector2d &a = corners_[i], along = corners_[(i + 1) % corners_.size()] - a, to = place - a;
    inside = std::min(inside, cross(along.normalized(), to));
    const double at = std::clamp(to.dot(along) / along.squaredNorm(), 0., 1.);
    nearest = std::min(nearest, (to - at * along).norm());
  }
  return inside >= 0 ? inside : -nearest;
}

Eigen::Vector2d Support::centre_of_pressure(const Wrench& reaction) const {
  const Eigen::Vector3d &f = reaction.force, &m = reaction.moment;
  return Eigen::Vector2d(floor_ * f.x() - m.y(), floor_ * f.y() + m.x()) / f.z();
}

double Support::margin(const Wrench& reaction) const {
  return reaction.force.z() > 0 ? margin(centre_of_pressure(reaction))
                                : -std::numeric_limits<double>::infinity();
}

double needed_grip(const Wrench& reaction) {
  return reaction.force.z() > 0 ? reaction.force.head<2>().norm() / reaction.force.z()
                                : std::numeric_limits<double>::infinity();
}

}  // namespace hbr::inline robots
