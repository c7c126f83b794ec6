// A body that moves by torques under gravity.
#pragma once

#include "models/robot/body/body.h"

namespace hbr::inline robots {

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

}  // namespace hbr::inline robots
