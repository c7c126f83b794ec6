#include "models/robot/description/robot_model.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/core/check.h"

namespace hbr::inline robots {
namespace {

template <class Items>
int find(const RobotModel& model, const Items& items, const char* what, const std::string& name) {
  for (std::size_t i = 0; i < items.size(); ++i)
    if (items[i].name == name) return static_cast<int>(i);
  std::vector<std::string> names;
  for (const auto& item : items) names.push_back(item.name);
  throw InputError("{}: the robot has no {} '{}'; it has: {}", model.path.string(), what, name,
                   fmt::join(names, ", "));
}

}  // namespace

Eigen::Isometry3d Joint::motion(double position) const {
  Eigen::Isometry3d result = origin;
  if (kind == Kind::prismatic) result.translate(position * axis);
  if (kind == Kind::revolute || kind == Kind::continuous) result.rotate(Eigen::AngleAxisd(position, axis));
  return result;
}

double Joint::within_a_turn(double position) const {
  return kind == Kind::continuous ? std::remainder(position, 2 * std::numbers::pi) : position;
}

int RobotModel::link(const std::string& link_name) const { return find(*this, links, "link", link_name); }

int RobotModel::joint(const std::string& joint_name) const {
  return find(*this, joints, "joint", joint_name);
}

std::pair<double, double> RobotModel::range(int joint_index) const {
  std::pair<double, double> result(joints[joint_index].lower, joints[joint_index].upper);
  for (const Joint& follower : joints) {
    if (follower.mimic != joint_index || follower.multiplier == 0 || follower.kind == Joint::Kind::continuous)
      continue;
    const auto [low, high] = std::minmax({(follower.lower - follower.offset) / follower.multiplier,
                                          (follower.upper - follower.offset) / follower.multiplier});
    const double lower = std::max(result.first, low), upper = std::min(result.second, high);
    if (lower < upper) result = {lower, upper};
  }
  return result;
}

std::vector<std::string> RobotModel::independent_joints() const {
  std::vector<std::string> names;
  for (const Joint& joint : joints)
    if (joint.kind != Joint::Kind::fixed && joint.mimic < 0) names.push_back(joint.name);
  return names;
}

}  // namespace hbr::inline robots
