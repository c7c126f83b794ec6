// load_urdf: urdfdom reads the contents, this file checks that they can be a body.
#include <console_bridge/console.h>
#include <fmt/ranges.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <iterator>
#include <mutex>
#include <numbers>

#include "models/robot/description/parts.h"
#include "models/robot/description/urdf_outline.h"
#include "pipeline/core/check.h"

namespace hbr {
namespace {

// Keeps the first two errors that urdfdom reports, which it would print otherwise: what is wrong, and where.
class FirstErrors : public console_bridge::OutputHandler {
 public:
  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level < console_bridge::CONSOLE_BRIDGE_LOG_ERROR || ++count > 2) return;
    message += (message.empty() ? "" : "; ") + text;
  }
  std::string message;
  int count = 0;
};

urdf::ModelInterfaceSharedPtr parse(const std::string& path, const std::string& text) {
  static std::mutex mutex;  // console_bridge has one handler for the whole program
  const std::lock_guard lock(mutex);
  FirstErrors errors;
  console_bridge::OutputHandler* const before = console_bridge::getOutputHandler();
  console_bridge::useOutputHandler(&errors);
  urdf::ModelInterfaceSharedPtr model;
  try {
    model = urdf::parseURDF(text);
  } catch (const std::exception& error) {
    errors.message = error.what();
  }
  console_bridge::useOutputHandler(before);
  if (!model || !errors.message.empty())
    throw InputError("{}: {}", path, errors.message.empty() ? "not a URDF" : errors.message);
  return model;
}

Eigen::Vector3d vector(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

Eigen::Isometry3d pose(const urdf::Pose& p) {
  double x, y, z, w;
  p.rotation.getQuaternion(x, y, z, w);
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.translate(vector(p.position));
  result.rotate(Eigen::Quaterniond(w, x, y, z).normalized());
  return result;
}

std::string shown(const Eigen::Vector3d& v) {
  return fmt::format("{:.4g}, {:.4g}, {:.4g}", v[0], v[1], v[2]);
}

// Nothing for a mere frame: many programs write one as a body of no mass and no inertia.
std::optional<Inertial> inertial(const urdf::Inertial& in, const std::string& where) {
  if (in.mass == 0 && in.ixx == 0 && in.ixy == 0 && in.ixz == 0 && in.iyy == 0 && in.iyz == 0 && in.izz == 0)
    return {};
  if (!(in.mass >= 0) || !std::isfinite(in.mass))
    throw InputError("{}: the mass is {} kg; expected more than 0 (leave <inertial> out for a mere frame)",
                     where, in.mass);
  const Eigen::Isometry3d frame = pose(in.origin);
  Eigen::Matrix3d inertia;
  inertia << in.ixx, in.ixy, in.ixz, in.ixy, in.iyy, in.iyz, in.ixz, in.iyz, in.izz;
  if (!inertia.allFinite() || !frame.matrix().allFinite())
    throw InputError("{}: <inertial> holds a number that is not finite", where);
  return Inertial{in.mass, frame.translation(), frame.linear() * inertia * frame.linear().transpose()};
}

Visual visual(const urdf::Visual& in, const std::string& where) {
  Visual out{Visual::Kind::mesh, pose(in.origin), {}, {1, 1, 1}, {}};
  if (!in.geometry) throw InputError("{}: <visual> has no geometry", where);
  if (auto* mesh = dynamic_cast<const urdf::Mesh*>(in.geometry.get())) {
    out.mesh = mesh->filename;
    if (std::ranges::any_of(out.mesh, [](unsigned char c) { return std::iscntrl(c); }))
      throw InputError("{}: the name of a mesh, '{}', holds a control character", where, out.mesh);
    out.size = vector(mesh->scale);
  } else if (auto* box = dynamic_cast<const urdf::Box*>(in.geometry.get())) {
    out.kind = Visual::Kind::box;
    out.size = vector(box->dim);
  } else if (auto* cylinder = dynamic_cast<const urdf::Cylinder*>(in.geometry.get())) {
    out.kind = Visual::Kind::cylinder;
    out.size = {cylinder->radius, cylinder->radius, cylinder->length};
  } else if (auto* sphere = dynamic_cast<const urdf::Sphere*>(in.geometry.get())) {
    out.kind = Visual::Kind::sphere;
    out.size.setConstant(sphere->radius);
  }
  if (!out.size.allFinite() || !(out.size.array().abs() > 0).all() ||
      (out.kind != Visual::Kind::mesh && !(out.size.array() > 0).all()))
    throw InputError("{}: <visual> has the size or scale {}; expected more than 0", where, shown(out.size));
  if (!out.pose.matrix().allFinite()) throw InputError("{}: the origin of <visual> is not finite", where);
  if (in.material)
    out.colour = Eigen::Vector3f(in.material->color.r, in.material->color.g, in.material->color.b);
  return out;
}

Joint joint(const urdf::Joint& in, const std::string& where) {
  Joint out{in.name, Joint::Kind::fixed, 0, 0, pose(in.parent_to_joint_origin_transform), {1, 0, 0}, 0, 0, 0,
            0};
  if (!out.origin.matrix().allFinite()) throw InputError("{}: its origin is not finite", where);
  if (in.type == urdf::Joint::FIXED) return out;
  out.kind = in.type == urdf::Joint::REVOLUTE    ? Joint::Kind::revolute
             : in.type == urdf::Joint::PRISMATIC ? Joint::Kind::prismatic
                                                 : Joint::Kind::continuous;
  const Eigen::Vector3d axis = vector(in.axis);
  if (!(axis.norm() > 1e-9) || !axis.allFinite())
    throw InputError("{}: its axis is {}; expected a direction", where, shown(axis));
  out.axis = axis.normalized();
  if (in.limits) {
    out.effort = in.limits->effort;
    out.velocity = in.limits->velocity;
    if (!(out.effort >= 0) || !(out.velocity >= 0))
      throw InputError("{}: effort {} and velocity {}; expected neither below 0", where, out.effort,
                       out.velocity);
  }
  if (out.kind == Joint::Kind::continuous) {
    out.lower = -std::numbers::pi;
    out.upper = std::numbers::pi;
  } else {
    if (!in.limits) throw InputError("{}: it has no <limit>", where);
    out.lower = in.limits->lower;
    out.upper = in.limits->upper;
    if (!std::isfinite(out.lower) || !std::isfinite(out.upper) || out.lower > out.upper)
      throw InputError("{}: the limits are [{}, {}]; expected lower <= upper", where, out.lower, out.upper);
  }
  return out;
}

void link_mimics(RobotModel& model, const urdf::ModelInterface& in, const UrdfOutline& outline) {
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    Joint& follower = model.joints[i];
    const auto& mimic = in.getJoint(follower.name)->mimic;
    if (!mimic) continue;
    const std::string where =
        fmt::format("{}:{}: joint '{}'", model.path.string(), outline.joints[i].line, follower.name);
    if (follower.kind == Joint::Kind::fixed) throw InputError("{} is fixed and can't mimic another", where);
    if (!std::isfinite(mimic->multiplier) || !std::isfinite(mimic->offset))
      throw InputError("{}: multiplier or offset of <mimic> is not finite", where);
    for (std::size_t j = 0; j < model.joints.size(); ++j)
      if (model.joints[j].name == mimic->joint_name) follower.mimic = static_cast<int>(j);
    if (follower.mimic < 0)
      throw InputError("{} mimics joint '{}', which is not in the file", where, mimic->joint_name);
    follower.multiplier = mimic->multiplier;
    follower.offset = mimic->offset;
  }
  for (const Joint& follower : model.joints) {
    if (follower.mimic < 0) continue;
    const Joint& leader = model.joints[follower.mimic];
    if (leader.mimic >= 0 || leader.kind == Joint::Kind::fixed)
      throw InputError("{}: joint '{}' mimics joint '{}', which {}; expected a joint that moves by itself",
                       model.path.string(), follower.name, leader.name,
                       leader.mimic >= 0 ? "is a mimic joint too" : "is fixed");
  }
}

// What a joint moves has a mass and inertia above 0, or none at all: then it must not be moved.
void check_masses(const RobotModel& model, const UrdfOutline& outline) {
  const Parts parts = join_parts(model, model.independent_joints(), {});
  for (std::size_t p = 1; p < parts.parts.size(); ++p) {
    const Part& part = parts.parts[p];
    if (part.fault.kind != MassFault::Kind::not_positive) continue;
    int first = -1, others = -1;  // of the part's links with an <inertial>
    for (int i = static_cast<int>(model.links.size()) - 1; i >= 0; --i)
      if (parts.places[i].part == static_cast<int>(p) &&
          (model.links[i].inertial || model.links[i].weightless_inertia)) {
        first = i;
        ++others;
      }
    if (first < 0) continue;
    throw InputError("{}:{}: link '{}'{}: {} (leave <inertial> out for a mere frame)", model.path.string(),
                     outline.links[first].line, model.links[first].name,
                     others ? " and what is fixed to it" : "", part.fault.why);
  }
}

RobotModel read_urdf(const std::filesystem::path& path) {
  std::error_code ignored;  // a pipe might never end
  const bool is_file = std::filesystem::is_regular_file(path, ignored);
  std::ifstream file;
  if (is_file) file.open(path, std::ios::binary);
  if (!is_file || !file) throw InputError("{}: can't be read; expected a URDF", path.string());
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};

  const UrdfOutline outline = read_outline(path, text);
  const auto in = parse(path.string(), text);
  RobotModel model{in->getName(), path, {}, {}};
  for (std::size_t i = 0; i < outline.links.size(); ++i) {
    const auto& [name, line] = outline.links[i];
    const std::string where = fmt::format("{}:{}: link '{}'", path.string(), line, name);
    const urdf::LinkConstSharedPtr link = in->getLink(name);
    Link out{name, {}, {}, static_cast<int>(i) - 1};
    if (link->inertial) out.inertial = inertial(*link->inertial, where);
    if (out.inertial && out.inertial->mass == 0) {
      out.weightless_inertia = true;
      out.inertial.reset();
    }
    for (const auto& shape : link->visual_array) out.visuals.push_back(visual(*shape, where));
    model.links.push_back(std::move(out));
  }
  for (std::size_t i = 0; i < outline.joints.size(); ++i) {
    const auto& at = outline.joints[i];
    const std::string where = fmt::format("{}:{}: joint '{}'", path.string(), at.line, at.name);
    Joint out = joint(*in->getJoint(at.name), where);
    out.parent = model.link(at.parent);
    out.child = static_cast<int>(i) + 1;
    model.joints.push_back(std::move(out));
  }
  link_mimics(model, *in, outline);
  check_masses(model, outline);
  return model;
}

}  // namespace

RobotModel load_urdf(const std::filesystem::path& path) {
  try {
    return read_urdf(path);
  } catch (const InputError& error) {
    std::string line = error.what();  // names and values of the file may hold anything
    for (char& c : line)
      if (std::iscntrl(static_cast<unsigned char>(c))) c = ' ';
    constexpr std::size_t kLongest = 1000;
    if (line.size() > kLongest) line = line.substr(0, kLongest) + " ...";
    throw InputError("{}", line);
  }
}

}  // namespace hbr
