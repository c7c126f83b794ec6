#include "models/robot/plane/drawing_servos.h"

#include <algorithm>
#include <cmath>

#include "pipeline/core/check.h"

namespace hbr {

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

DrawingServos::DrawingServos(std::shared_ptr<const Body> body, const RobotSettings& robot)
    : body_(std::move(body)), posture_(body_->posture(robot.rest())) {
  for (const std::string& joint : robot.joints) {
    const auto at = std::ranges::find(body_->moving(), joint);
    if (at == body_->moving().end())
      throw InputError("robot '{}': joint '{}' moves less than dynamics.lightest; expected a lower one",
                       robot.name, joint);
    drawing_.push_back(static_cast<int>(at - body_->moving().begin()));
  }
}

std::shared_ptr<const Body> whole_body(const RobotModel& model, const RobotSettings& robot, double lightest) {
  const std::vector<std::string> joints = joints_with_inertia(model, robot.rest(), lightest);
  if (joints.size() == robot.joints.size() && robot.stands_on.empty()) return nullptr;
  return std::make_shared<const Body>(model, joints, robot.rest(), robot.stands_on);
}

}  // namespace hbr
