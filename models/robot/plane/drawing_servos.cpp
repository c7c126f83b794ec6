#include "models/robot/plane/drawing_servos.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "pipeline/core/check.h"

namespace hbr::inline robots {

ReplayErrors replay_errors(const Replay& replay, const DrawingPlane& plane) {
  double sum = 0;
  ReplayErrors errors{0, 0, 0};
  for (std::size_t k = 0; k < replay.tip.size(); ++k) {
    const double error = (replay.tip[k] - replay.wanted[k]).norm();
    sum += error * error;
    errors.worst = std::max(errors.worst, error);
    errors.off_plane = std::max(errors.off_plane, std::abs(plane.to_pen(replay.tip[k]).off_plane));
  }
  errors.rms = std::sqrt(sum / static_cast<double>(replay.tip.size()));
  return errors;
}

std::vector<float> pen_of(const std::vector<Eigen::Vector3d>& tip, const DrawingPlane& plane) {
  std::vector<float> pen;
  for (const Eigen::Vector3d& p : tip) {
    const Eigen::Vector2f at = plane.to_pen(p).position.cast<float>();
    pen.insert(pen.end(), {at.x(), at.y()});
  }
  return pen;
}

std::vector<Eigen::Vector3d> exact_way(const RobotOnPlane& robot, const JointPath& movement,
                                       const ServoSettings& servos) {
  std::vector<Eigen::Vector3d> way;
  const double period = servos.step * servos.control_every;
  for (int k = 0; k <= static_cast<int>(std::ceil(movement.duration() / period)); ++k)
    way.push_back(robot.body().position(robot.tip(), movement.at(k * period).position.data()));
  return way;
}

DrawingServos::DrawingServos(std::shared_ptr<const Body> body, const RobotSettings& robot,
                             const std::vector<GearSettings>& gears, std::optional<Support> support)
    : body_(std::move(body)), posture_(body_->posture(robot.rest())), support_(std::move(support)) {
  for (const std::string& joint : robot.joints) {
    const auto at = std::ranges::find(body_->moving(), joint);
    if (at == body_->moving().end())
      throw InputError("robot '{}': joint '{}' draws, but this body can not move it", robot.name, joint);
    drawing_.push_back(static_cast<int>(at - body_->moving().begin()));
  }
  if (gears.empty()) return;
  for (Eigen::ArrayXd* each : {&gears_.viscous, &gears_.coulomb, &gears_.play}) each->setZero(body_->dof());
  for (std::size_t i = 0; i < gears.size(); ++i) {
    const GearSettings& gear = gears[i];
    const auto at = std::ranges::find(robot.joints, gear.joint);
    const auto joint_of = [&](const GearSettings& other) { return other.joint == gear.joint; };
    if (at == robot.joints.end() || std::any_of(gears.begin(), gears.begin() + i, joint_of))
      throw InputError("robot '{}': gears: '{}'; expected each of its joints that draw at most once: {}",
                       robot.name, gear.joint, fmt::join(robot.joints, ", "));
    const int joint = drawing_[static_cast<std::size_t>(at - robot.joints.begin())];
    gears_.viscous[joint] = gear.viscous;
    gears_.coulomb[joint] = gear.coulomb;
    gears_.play[joint] = gear.play;
  }
}

PacedPath path_within_limits(const std::vector<double>& joints, std::vector<double> times, double smoothing,
                             const std::vector<const DrawingServos*>& bodies, double every, double longest) {
  PacedPath movement{JointPath(joints, times, smoothing)};
  double pace = 1;
  for (const DrawingServos* body : bodies) pace = std::min(pace, 0.9 * body->fastest(movement, every).factor);
  // Standing still may be too much, so that no pace helps.
  if (pace >= 1 || pace <= 0 || times.back() / pace > longest) return movement;
  for (double& time : times) time /= pace;
  return {JointPath(joints, times, smoothing), pace};
}

std::shared_ptr<const Body> whole_body(const RobotModel& model, const RobotSettings& robot, double lightest) {
  std::vector<std::string> joints = joints_with_inertia(model, robot.rest(), lightest);
  for (const std::string& draws : robot.joints)
    if (std::ranges::find(joints, draws) == joints.end()) joints.push_back(draws);
  if (joints.size() == robot.joints.size() && robot.stands_on.empty()) return nullptr;
  return std::make_shared<const Body>(model, joints, robot.rest(), robot.stands_on);
}

}  // namespace hbr::inline robots
