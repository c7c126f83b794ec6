// Servos of joints, and what they make of a path.
#pragma once

#include <limits>
#include <vector>

#include "models/robot/body/gears.h"
#include "models/robot/body/joint_path.h"
#include "models/robot/body/motion.h"
#include "models/robot/body/support.h"

namespace hbr::inline robots {

struct ServoSettings {
  double step = 0;        // of the integration, s
  int control_every = 0;  // steps between two commands to the joints that draw; torques stay in between
  double drawing_hz = 0;  // frequency at which an error of a joint that draws dies away, critically damped
  double holding_hz = 0;  // the same of a joint that holds its place, alone
};

// The joints' limits, of the URDF: N m and rad/s; 0 where it names none.
struct ServoLimits {
  Eigen::VectorXd torque, speed;
};
ServoLimits servo_limits(const Body& body);

// What a movement came to, at every command.
struct Replay {
  std::vector<Eigen::Vector3d> wanted, tip;  // m
  // [dof] the greatest that was asked for, as a share of the limit (above 1: more than there was); 0 where
  // there is no limit.
  Eigen::VectorXd torque, speed;
  // Where the body has a sole: how far the centre of pressure was inside it at least, m (Support), and the
  // coefficient of friction that kept the sole from slipping.
  double margin = std::numeric_limits<double>::infinity(), grip = 0;
};

// What a movement meets besides inertia and weight.
struct Mechanics {
  Gears gears;                       // empty: none
  const Support* support = nullptr;  // of a body that stands on a sole
};

// Joint `drawing[k]` of the body follows joint k of the path by computed torque: what the equations of motion
// ask for the path's acceleration and for the correction of errors, were the other joints rigid. These hold
// where `posture` has them: by the torques that bear the weight at the start, and as springs and dampers that
// fit the inertia that each of them bears alone there. A torque beyond its limit is cut off, and a joint
// beyond its top speed gets none in that direction. The servos know nothing of the gears: they measure the
// motors, which stand at the start where the path does.
Replay replay(const Body& body, int tip, const JointPath& path, const std::vector<int>& drawing,
              const Eigen::VectorXd& posture, const ServoSettings& settings, const Mechanics& mechanics = {});

// How much faster than the path the movement can be until a joint reaches its torque or speed limit (inverse
// dynamics at the path's points `every` seconds apart, the other joints rigid).
struct Fastest {
  double factor;   // 0 where standing still is too much; kFastest where nothing is reached below it
  int joint;       // of the body
  bool by_torque;  // else by speed
};
inline constexpr double kFastest = 1000;
Fastest fastest(const Body& body, const JointPath& path, const std::vector<int>& drawing,
                const Eigen::VectorXd& posture, double every);

// Independent joints of a model that move at least this inertia [kg m^2; kg for prismatic ones] about
// themselves in the posture `rest`. Lighter ones are fingers and the like: stiff to any servo.
std::vector<std::string> joints_with_inertia(const RobotModel& model,
                                             const std::map<std::string, double>& rest, double least);

}  // namespace hbr::inline robots
