#include "models/robot/body/gears.h"

#include <algorithm>
#include <cmath>

namespace hbr::inline robots {
namespace {

constexpr int kSweeps = 10000;
constexpr double kExact = 1e-13;  // of the greatest speed

}  // namespace

Eigen::VectorXd friction_torques(const Gears& gears, const Motion& motion, const Eigen::VectorXd& torques,
                                 double seconds) {
  const Equations& equations = motion.equations();
  Eigen::MatrixXd mass = equations.mass;
  mass.diagonal() += Eigen::VectorXd(seconds * gears.viscous);
  const Eigen::VectorXd impulse = equations.mass * motion.speeds() + seconds * (torques - equations.bias);
  // By coordinate descent: each joint in its turn takes the speed that is best while the others keep theirs.
  Eigen::VectorXd speeds = motion.speeds();
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    double change = 0;
    for (Eigen::Index i = 0; i < speeds.size(); ++i) {
      const double push = impulse[i] - mass.row(i).dot(speeds) + mass(i, i) * speeds[i];
      const double left = std::max(0., std::abs(push) - seconds * gears.coulomb[i]);
      const double speed = std::copysign(left, push) / mass(i, i);
      change = std::max(change, std::abs(speed - speeds[i]));
      speeds[i] = speed;
    }
    if (change <= kExact * speeds.lpNorm<Eigen::Infinity>()) break;
  }
  return equations.mass * (speeds - motion.speeds()) / seconds + equations.bias - torques;
}

Motors::Motors(const Gears& gears, const Eigen::VectorXd& joints, const Eigen::VectorXd& loads)
    : play_(gears.play),
      positions_(joints),
      speeds_(Eigen::VectorXd::Zero(joints.size())),
      side_(joints.size()) {
  for (Eigen::Index i = 0; i < joints.size(); ++i) {
    side_[i] = loads[i] < 0 ? -1 : 1;
    if (play_.size() > 0) positions_[i] += side_[i] * play_[i] / 2;
  }
}

Eigen::VectorXd Motors::joints_under(const Gears& gears, Eigen::VectorXd motors,
                                     const Eigen::VectorXd& loads) {
  for (Eigen::Index i = 0; i < gears.play.size(); ++i)
    motors[i] -= (loads[i] < 0 ? -1 : 1) * gears.play[i] / 2;
  return motors;
}

Eigen::VectorXd Motors::handed_on(Eigen::VectorXd torques) const {
  for (Eigen::Index i = 0; i < torques.size(); ++i)
    if (!pushes(i, torques[i])) torques[i] = 0;
  return torques;
}

void Motors::follow(const Motion& motion, const Eigen::VectorXd& torques,
                    const Eigen::VectorXd& accelerations, double seconds) {
  for (Eigen::Index i = 0; i < positions_.size(); ++i) {
    const double joint = motion.joints()[i], half = play_.size() > 0 ? play_[i] / 2 : 0;
    if (!pushes(i, torques[i])) {
      speeds_[i] += seconds * accelerations[i];
      positions_[i] += seconds * speeds_[i];
      side_[i] = positions_[i] >= joint + half ? 1 : positions_[i] <= joint - half ? -1 : 0;
      if (side_[i] == 0) continue;
    }
    positions_[i] = half > 0 ? joint + side_[i] * half : joint;
    speeds_[i] = motion.speeds()[i];
  }
}

}  // namespace hbr::inline robots
