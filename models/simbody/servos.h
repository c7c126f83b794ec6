// A body moved by the servos of its joints under gravity.
#pragma once

#include <vector>

#include "models/simbody/body.h"
#include "models/simbody/joint_path.h"

namespace hbr {

inline const Eigen::Vector3d kGravity(0, 0, -9.80665);  // m/s^2: the root link's z points up

// Springs and dampers at the joints; zeros where a joint has none.
struct Springs {
  Eigen::ArrayXd stiffness, damping;  // N m/rad, N m s/rad
  Eigen::ArrayXd rest;                // rad
};

// A body that obeys its equations of motion; semi-explicit Euler.
class Motion {
 public:
  Motion(const Body& body, Eigen::VectorXd joints, Eigen::VectorXd speeds,
         const Eigen::Vector3d& gravity = kGravity);

  const Eigen::VectorXd& joints() const { return joints_; }
  const Eigen::VectorXd& speeds() const { return speeds_; }
  // Here and now.
  const Equations& equations() const { return equations_; }
  // Kinetic and potential, without the springs', J.
  double energy() const;
  void step(const Eigen::VectorXd& torques, double seconds);
  // What springs give beside those torques during a step: the torques of where it ends, so that no spring is
  // too stiff for the step.
  Eigen::VectorXd spring_torques(const Springs& springs, const Eigen::VectorXd& torques,
                                 double seconds) const;

 private:
  const Body& body_;
  Eigen::Vector3d gravity_;
  Eigen::VectorXd joints_, speeds_;
  Equations equations_;
};

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
};

// Joint `drawing[k]` of the body follows joint k of the path by computed torque: what the equations of motion
// ask for the path's acceleration and for the correction of errors, were the other joints rigid. These hold
// where `posture` has them: by the torques that bear the weight at the start, and as springs and dampers that
// fit the inertia that each of them bears alone there. A torque beyond its limit is cut off, and a joint
// beyond its top speed gets none in that direction.
Replay replay(const Body& body, int tip, const JointPath& path, const std::vector<int>& drawing,
              const Eigen::VectorXd& posture, const ServoSettings& settings);

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

}  // namespace hbr
