// What gears do between a motor and its joint: friction, and play.
#pragma once

#include "models/robot/body/motion.h"

namespace hbr::inline robots {

// One value for each joint of a body; 0 where there is none, empty arrays where no joint has any.
struct Gears {
  Eigen::ArrayXd viscous;  // friction that grows with the speed, N m s/rad (N s/m)
  Eigen::ArrayXd coulomb;  // friction of the same torque at any speed, which holds a joint still, N m (N)
  Eigen::ArrayXd play;     // how far the joint moves while its motor stands, rad (m)

  bool rub() const { return (viscous > 0).any() || (coulomb > 0).any(); }
};

// The torques of friction beside these torques during a step: -viscous * v - coulomb * sign(v) for the speeds
// v at the step's end, and where v is 0 as much as that takes, at most `coulomb`. These are the speeds of
// least
//   1/2 v'(M + h D)v - v'(M v0 + h (torques - bias)) + h sum coulomb |v|
// (time-stepping: J. J. Moreau 1988), so a joint that sticks does not move at all, and no step is too long.
Eigen::VectorXd friction_torques(const Gears& gears, const Motion& motion, const Eigen::VectorXd& torques,
                                 double seconds);

// Motors in loose gears. A motor's own inertia counts as none beside that of
// what its joint moves: while it pushes one side of its gear it moves with the joint and hands its torque on;
// while it has nothing to push it accelerates as its servo wants it, the joint moves freely, and where
// they meet again the motor takes the joint's speed. Servos measure the motors.
class Motors {
 public:
  // Every motor pushes with the sign of `loads`.
  Motors(const Gears& gears, const Eigen::VectorXd& joints, const Eigen::VectorXd& loads);

  // Where joints stand whose motors stand there and push so.
  static Eigen::VectorXd joints_under(const Gears& gears, Eigen::VectorXd motors,
                                      const Eigen::VectorXd& loads);

  const Eigen::VectorXd& positions() const { return positions_; }
  const Eigen::VectorXd& speeds() const { return speeds_; }

  // Of these torques those that reach the joints.
  Eigen::VectorXd handed_on(Eigen::VectorXd torques) const;

  // After a step in which the servos gave these torques and wanted these accelerations.
  void follow(const Motion& motion, const Eigen::VectorXd& torques, const Eigen::VectorXd& accelerations,
              double seconds);

 private:
  bool pushes(Eigen::Index joint, double torque) const {
    return play_.size() == 0 || play_[joint] == 0 || torque * side_[joint] > 0;
  }

  Eigen::ArrayXd play_;
  Eigen::VectorXd positions_, speeds_;
  Eigen::ArrayXi side_;  // of the gear that the motor touches: -1, 0 for none, 1
};

}  // namespace hbr::inline robots
