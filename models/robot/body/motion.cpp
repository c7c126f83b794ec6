#include "models/robot/body/motion.h"

#include <Eigen/Cholesky>

namespace hbr::inline robots {

Motion::Motion(const Body& body, Eigen::VectorXd joints, Eigen::VectorXd speeds,
               const Eigen::Vector3d& gravity)
    : body_(body), gravity_(gravity), joints_(std::move(joints)), speeds_(std::move(speeds)) {
  body_.equations(joints_, speeds_, gravity_, equations_);
}

double Motion::energy() const {
  return 0.5 * speeds_.dot(equations_.mass * speeds_) -
         body_.mass() * gravity_.dot(body_.centre_of_mass(joints_));
}

void Motion::step(const Eigen::VectorXd& torques, double seconds) {
  speeds_ += seconds * equations_.mass.llt().solve(torques - equations_.bias);
  joints_ += seconds * speeds_;
  body_.equations(joints_, speeds_, gravity_, equations_);
}

Eigen::VectorXd Motion::spring_torques(const Springs& springs, const Eigen::VectorXd& torques,
                                       double seconds) const {
  // After the step the joints stand at q + h v', with v' = v + h a: the springs' torque -k (q - rest) - (d +
  // h k) v' is linear in the unknown v'.
  const Eigen::VectorXd by_speed = springs.damping + seconds * springs.stiffness,
                        stretched = -springs.stiffness * (joints_.array() - springs.rest);
  Eigen::MatrixXd mass = equations_.mass;
  mass.diagonal() += seconds * by_speed;
  const Eigen::VectorXd speeds =
      mass.llt().solve(equations_.mass * speeds_ + seconds * (torques + stretched - equations_.bias));
  return stretched - by_speed.cwiseProduct(speeds);
}

}  // namespace hbr::inline robots
