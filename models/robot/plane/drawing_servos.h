// The servos of a body that replays what a robot draws.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "models/robot/body/servos.h"
#include "models/robot/plane/robot_on_plane.h"

namespace hbr::inline robots {

// How far a replay's tip is from where it should be, m: by root mean square, at most; and at most off the
// plane.
struct ReplayErrors {
  double rms, worst, off_plane;
};
ReplayErrors replay_errors(const Replay& replay, const DrawingPlane& plane);

// A tip's way [n] as the pen's, [n x 2] m of the arm.
std::vector<float> pen_of(const std::vector<Eigen::Vector3d>& tip, const DrawingPlane& plane);

// The tip's way along a movement that is followed exactly, at every command.
std::vector<Eigen::Vector3d> exact_way(const RobotOnPlane& robot, const JointPath& movement,
                                       const ServoSettings& servos);

// A movement, and its pace over the one that was asked for.
struct PacedPath {
  JointPath path;
  double pace = 1;
};

class DrawingServos {
 public:
  // Of the robot's table the joints that draw, and the posture in which the body's others hold; what the
  // gears of some lose; the sole that the body stands on, if it does. Throws InputError where the body lacks
  // one of the joints that draw, or where a gear's joint is none of these or has another gear.
  DrawingServos(std::shared_ptr<const Body> body, const RobotSettings& robot,
                const std::vector<GearSettings>& gears = {}, std::optional<Support> support = {});

  const Body& body() const { return *body_; }
  bool stands() const { return support_.has_value(); }
  Replay replay(int tip, const JointPath& path, const ServoSettings& servos) const {
    return hbr::replay(*body_, tip, path, drawing_, posture_, servos,
                       {gears_, support_ ? &*support_ : nullptr});
  }
  // Over the pace that was asked for.
  Fastest fastest(const PacedPath& movement, double every) const {
    Fastest result = hbr::fastest(*body_, movement.path, drawing_, posture_, every);
    result.factor = std::min(kFastest, movement.pace * result.factor);
    return result;
  }

 private:
  std::shared_ptr<const Body> body_;
  std::vector<int> drawing_;  // the body's joints that draw, in the order of the path's
  Eigen::VectorXd posture_;
  Gears gears_;
  std::optional<Support> support_;
};

// The movement through configurations at these times (see JointPath) or, where that asks a joint of one of
// the bodies for too much, a tenth below the pace that does not, unless it then takes longer than `longest`,
// s. Looks at every so many seconds.
PacedPath path_within_limits(const std::vector<double>& joints, std::vector<double> times, double smoothing,
                             const std::vector<const DrawingServos*>& bodies, double every, double longest);

// The robot with all joints that move at least that inertia, kg m^2, and those that draw, on the link that it
// stands on; none where those that draw are all that there is.
std::shared_ptr<const Body> whole_body(const RobotModel& model, const RobotSettings& robot, double lightest);

}  // namespace hbr::inline robots
