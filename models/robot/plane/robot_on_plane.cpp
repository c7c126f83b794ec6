#include "models/robot/plane/robot_on_plane.h"

#include <vector>

#include "pipeline/core/check.h"

namespace hbr::inline robots {
namespace {

void refuse_impossible_rest(const RobotSettings& settings, const RobotModel& model) {
  for (const auto& [name, position] : settings.rest()) {
    const int at = model.joint(name);
    if (const int leader = model.joints[at].mimic; leader >= 0)
      throw InputError("robot '{}': rest_joints has '{}', which mimics joint '{}' in {}; name that one",
                       settings.name, name, model.joints[leader].name, model.path.string());
    const double stands = model.joints[at].within_a_turn(position);
    const auto [lower, upper] = model.range(at);
    if (stands < lower || stands > upper)
      throw InputError("robot '{}': rest_positions has joint '{}' at {}; expected {} to {}, its limits in {}",
                       settings.name, name, position, lower, upper, model.path.string());
  }
}

}  // namespace

RobotOnPlane::RobotOnPlane(std::string name, std::shared_ptr<const Body> body, const std::string& tip,
                           const DrawingPlane& plane, double off_plane_tolerance)
    : name_(std::move(name)),
      body_(std::move(body)),
      tip_(body_->model().link(tip)),
      plane_(plane),
      tolerance_(off_plane_tolerance),
      clearance_(std::make_shared<const Clearance>(*body_, tip_)) {
  const std::vector<bool> moves = body_->moves(tip_);
  for (std::size_t i = 0; i < moves.size(); ++i)
    if (!moves[i])
      throw InputError("robot '{}': joint '{}' does not move the tip '{}'; leave it out of its joints", name_,
                       body_->moving()[i], tip);
  for (std::size_t i = 0; i < moves.size(); ++i)
    if (!(body_->lower()[i] < body_->upper()[i]))
      throw InputError(
          "robot '{}': joint '{}' can only stand at {:g}: its <limit> is missing or leaves no range; give it "
          "one, or leave it out of its joints",
          name_, body_->moving()[i], body_->lower()[i]);
}

std::string RobotOnPlane::unit(Eigen::Index joint) const {
  const RobotModel& model = body_->model();
  const int at = model.joint(body_->moving()[static_cast<std::size_t>(joint)]);
  return model.joints[at].kind == Joint::Kind::prismatic ? "m" : "rad";
}

void RobotOnPlane::pens(Eigen::Index n, const double* joints, Pen* pens) const {
  std::vector<Eigen::Vector3d> hands(n);
  body_->positions(tip_, n, joints, hands.data());
  for (Eigen::Index i = 0; i < n; ++i) pens[i] = plane_.to_pen(hands[i]);
}

RobotOnPlane make_robot(const RobotSettings& settings, const DrawingPlane& plane) {
  if (settings.joints.empty()) throw InputError("robot '{}': no joints to draw with", settings.name);
  RobotModel model = load_urdf(settings.urdf);
  refuse_impossible_rest(settings, model);
  auto body = std::make_shared<const Body>(std::move(model), settings.joints, settings.rest());
  return RobotOnPlane(settings.name, std::move(body), settings.tip_link, plane, settings.off_plane_tolerance);
}

}  // namespace hbr::inline robots
