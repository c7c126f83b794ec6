#include "models/robot/description/urdf_joint.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace hbr::inline robots {
namespace {

Joint::Kind kind_of(UrdfText& text, const XMLElement& joint) {
  static const std::map<std::string, Joint::Kind> kinds = {{"revolute", Joint::Kind::revolute},
                                                           {"continuous", Joint::Kind::continuous},
                                                           {"prismatic", Joint::Kind::prismatic},
                                                           {"fixed", Joint::Kind::fixed}};
  const char* type = joint.Attribute("type");
  const std::string written = type ? type : "";
  if (const auto known = kinds.find(written); known != kinds.end()) return known->second;
  if (written != "floating" && written != "planar")
    text.refuse(joint, "has type '{}'; expected revolute, continuous, prismatic or fixed", written);
  text.odd(joint, "is {}: taken as fixed where it stands at 0", written);
  return Joint::Kind::fixed;
}

// Below 0 many write for "none", which is 0 here.
double strength(UrdfText& text, const XMLElement& joint, const char* attribute, bool needed) {
  const XMLElement* limit = joint.FirstChildElement("limit");
  const double value = text.number(limit, attribute, 0, kMostLimit);
  if (value > 0 || !limit) return value;
  if (!limit->Attribute(attribute) && needed)
    text.odd(*limit, "names no {}: taken as no limit", attribute);
  else if (needed || value < 0)
    text.odd(*limit, "has {} '{:g}': taken as no limit", attribute, value);
  return 0;
}

constexpr int kMostTurns = 300;  // of a joint with limits, were they degrees

void read_limits(UrdfText& text, const XMLElement& element, Joint& joint) {
  const XMLElement* limit = element.FirstChildElement("limit");
  const bool needed = joint.kind != Joint::Kind::continuous;
  joint.effort = strength(text, element, "effort", needed);
  joint.velocity = strength(text, element, "velocity", needed);
  if (joint.kind == Joint::Kind::continuous) {
    joint.lower = -std::numbers::pi;
    joint.upper = std::numbers::pi;
    return;
  }
  if (!limit) text.odd(element, "has no <limit>, which it needs to move: taken as standing at 0");
  joint.lower = text.number(limit, "lower", 0, kMostLimit);
  joint.upper = text.number(limit, "upper", 0, kMostLimit);
  if (joint.lower > joint.upper) {
    text.odd(*limit, "has lower '{:g}' above upper '{:g}': exchanged", joint.lower, joint.upper);
    std::swap(joint.lower, joint.upper);
  }
  if (joint.kind == Joint::Kind::prismatic || joint.upper - joint.lower <= kMostTurns * 2 * std::numbers::pi)
    return;
  text.odd(*limit, "has lower '{:g}' and upper '{:g}', more than {} turns: taken as turning without end",
           joint.lower, joint.upper, kMostTurns);
  joint.kind = Joint::Kind::continuous;
  joint.lower = -std::numbers::pi;
  joint.upper = std::numbers::pi;
}

// A URDF has one number for each, which simulators take differently; a profile says what is meant.
void tell_of_friction(UrdfText& text, const XMLElement& joint) {
  const XMLElement* dynamics = joint.FirstChildElement("dynamics");
  for (const char* attribute : {"damping", "friction"}) {
    const char* value = dynamics ? dynamics->Attribute(attribute) : nullptr;
    if (!value || numbers_in(value) == std::vector<double>{0}) continue;
    text.odd(*dynamics,
             "is left out; friction and play of joints that draw are told in a profile, in [[robots.gears]]");
    return;
  }
}

// Has a follower follow what moves by itself, or stands still, at the end of the chain of those that it
// follows.
void follow_to_the_end(const UrdfText& text, const XMLElement& element, const std::vector<Joint>& joints,
                       Joint& follower) {
  std::vector<std::string> way{follower.name};
  while (follower.mimic >= 0 && joints[follower.mimic].mimic >= 0) {
    const Joint& leader = joints[follower.mimic];
    const auto passed = std::ranges::find(way, leader.name);
    if (passed != way.end())
      text.refuse(element,
                  "never comes to a joint that moves by itself by its <mimic>: '{}' -> '{}' is a loop",
                  fmt::join(passed, way.end(), "' -> '"), leader.name);
    way.push_back(leader.name);
    follower.offset += follower.multiplier * leader.offset;
    follower.multiplier *= leader.multiplier;
    follower.mimic = leader.mimic;
  }
  if (follower.mimic >= 0 && std::max(std::abs(follower.multiplier), std::abs(follower.offset)) > kMostLimit)
    text.refuse(element, "follows '{}' by multiplier {:g} and offset {:g}; expected both within {:g}",
                joints[follower.mimic].name, follower.multiplier, follower.offset, kMostLimit);
}

}  // namespace

Joint read_joint(UrdfText& text, const XMLElement& element) {
  Joint joint{
      element.Attribute("name"), kind_of(text, element), 0, 0, text.origin(element), {1, 0, 0}, 0, 0, 0, 0};
  if (joint.kind == Joint::Kind::fixed) return joint;
  const XMLElement* axis = element.FirstChildElement("axis");
  const Eigen::Vector3d direction = text.three(axis, "xyz", {1, 0, 0});
  if (direction.norm() <= 1e-9) {
    text.odd(*axis, "is {:g} {:g} {:g}, no direction: the joint is taken as fixed where it stands at 0",
             direction[0], direction[1], direction[2]);
    joint.kind = Joint::Kind::fixed;
    return joint;
  }
  joint.axis = direction.normalized();
  read_limits(text, element, joint);
  tell_of_friction(text, element);
  return joint;
}

void link_mimics(UrdfText& text, const std::vector<const XMLElement*>& elements, std::vector<Joint>& joints) {
  std::map<std::string, int> index;
  for (std::size_t i = 0; i < joints.size(); ++i) index[joints[i].name] = static_cast<int>(i);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const XMLElement* mimic = elements[i]->FirstChildElement("mimic");
    if (!mimic) continue;
    if (joints[i].kind == Joint::Kind::fixed) {
      text.odd(*mimic, "is left out: the joint is fixed");
      continue;
    }
    const std::string leader = text.name(*mimic, "joint");
    const auto found = index.find(leader);
    if (found == index.end()) {
      text.odd(*mimic, "names joint '{}', which is not in the file: it moves by itself", leader);
      continue;
    }
    joints[i].mimic = found->second;
    joints[i].multiplier = text.number(mimic, "multiplier", 1);
    joints[i].offset = text.number(mimic, "offset", 0);
  }
  for (std::size_t i = 0; i < joints.size(); ++i) follow_to_the_end(text, *elements[i], joints, joints[i]);
  for (std::size_t i = 0; i < joints.size(); ++i) {
    Joint& follower = joints[i];
    if (follower.mimic < 0 || joints[follower.mimic].kind != Joint::Kind::fixed) continue;
    text.odd(*elements[i], "follows '{}', which is fixed: taken as fixed, too, where it stands at {:g}",
             joints[follower.mimic].name, follower.offset);
    follower.origin = follower.motion(follower.offset);
    follower.kind = Joint::Kind::fixed;
    follower.mimic = -1;
  }
}

}  // namespace hbr::inline robots
