#include "models/robot/description/parts.h"

#include <algorithm>
#include <cmath>

#include "pipeline/core/check.h"

namespace hbr::inline robots {
namespace {

// The coordinate of every joint, -1 for one that does not move.
std::vector<int> coordinates(const RobotModel& model, const std::vector<std::string>& moving) {
  std::vector<int> result(model.joints.size(), -1);
  for (std::size_t i = 0; i < moving.size(); ++i) {
    const int index = model.joint(moving[i]);
    const Joint& joint = model.joints[index];
    if (joint.kind == Joint::Kind::fixed)
      throw InputError("{}: joint '{}' is fixed and can't be moved", model.path.string(), joint.name);
    if (joint.mimic >= 0)
      throw InputError("{}: joint '{}' can't be moved by itself, it mimics joint '{}'", model.path.string(),
                       joint.name, model.joints[joint.mimic].name);
    if (result[index] >= 0)
      throw InputError("{}: joint '{}' is named twice among the joints to move", model.path.string(),
                       joint.name);
    result[index] = static_cast<int>(i);
  }
  for (std::size_t i = 0; i < model.joints.size(); ++i)
    if (model.joints[i].mimic >= 0) result[i] = result[model.joints[i].mimic];
  return result;
}

double rest_position(const RobotModel& model, int index, const std::map<std::string, double>& rest) {
  const Joint& joint = model.joints[index];
  if (joint.mimic >= 0) return joint.multiplier * rest_position(model, joint.mimic, rest) + joint.offset;
  const auto given = rest.find(joint.name);
  const auto [lower, upper] = model.range(index);
  return std::clamp(given == rest.end() ? 0 : joint.within_a_turn(given->second), lower, upper);
}

// The inertia that a mass in one point has about the origin.
Eigen::Matrix3d point_inertia(double mass, const Eigen::Vector3d& c) {
  return mass * (c.squaredNorm() * Eigen::Matrix3d::Identity() - c * c.transpose());
}

// Adds a link's mass, given in the link's frame, to the part's sums (the parallel-axis theorem).
void add_mass(Part& part, const Inertial& in, const Eigen::Isometry3d& pose) {
  const Eigen::Vector3d c = pose * in.centre;
  const Eigen::Matrix3d turned = pose.linear() * in.inertia * pose.linear().transpose();
  part.inertia_origin += turned + point_inertia(in.mass, c);
  part.centre = (part.mass * part.centre + in.mass * c) / (part.mass + in.mass);
  part.mass += in.mass;
}

// Finds what no body can be, and makes it one that can at least be moved about.
void judge(Part& part) {
  const Eigen::Matrix3d about_origin = point_inertia(part.mass, part.centre),
                        about_centre = part.inertia_origin - about_origin;
  part.fault = mass_fault(part.mass, part.centre, about_centre);
  if (part.fault.kind != MassFault::Kind::none)
    part.inertia_origin = nearest_possible(about_centre) + about_origin;
}

}  // namespace

Parts join_parts(const RobotModel& model, const std::vector<std::string>& moving,
                 const std::map<std::string, double>& rest) {
  for (const auto& [name, position] : rest) {
    model.joint(name);
    if (!std::isfinite(position))
      throw InputError("{}: the resting position of joint '{}' is {}", model.path.string(), name, position);
  }
  const std::vector<int> coordinate = coordinates(model, moving);

  Parts result;
  result.parts.push_back({});
  result.parts[0].origin.setIdentity();
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    Parts::Place place{0, Eigen::Isometry3d::Identity()};
    if (i > 0) {
      const Joint& joint = model.joints[i - 1];
      const Parts::Place& parent = result.places[joint.parent];
      if (coordinate[i - 1] >= 0) {
        Part part{parent.part,       static_cast<int>(i) - 1, parent.pose * joint.origin,
                  coordinate[i - 1], joint.multiplier,        joint.offset};
        place.part = static_cast<int>(result.parts.size());
        result.parts.push_back(part);
      } else {
        place = {parent.part,
                 parent.pose * joint.motion(rest_position(model, static_cast<int>(i) - 1, rest))};
      }
    }
    if (model.links[i].inertial) add_mass(result.parts[place.part], *model.links[i].inertial, place.pose);
    result.places.push_back(place);
  }
  for (Part& part : result.parts) judge(part);
  return result;
}

}  // namespace hbr::inline robots
