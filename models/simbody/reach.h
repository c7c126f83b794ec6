// How near a robot's tip can come to a point: inverse kinematics within the joints' limits.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "models/simbody/self_collision.h"
#include "pipeline/core/random.h"

namespace hbr {

class Reach {
 public:
  struct Nearest {
    Eigen::VectorXd joints;  // within the limits, kept off them by the margin
    Eigen::Vector3d gap;  // m, from the tip to the target: its length's gradient by the target is gap / |gap|
  };

  // Draws `samples` configurations and keeps those that run into nothing; inverse kinematics starts from
  // those whose tip is nearest to the target. `margin` in [0, 0.5): the share of a joint's range that is left
  // unused at either end.
  Reach(const Body& body, int tip, const SelfCollision& collision, int samples, double margin, Seed seed);

  // Levenberg-Marquardt (Ceres, bounded) from the nearest samples, up to `starts` of them, until one arrives
  // within `enough` metres. What runs into itself does not count. Thread-safe.
  Nearest nearest(const Eigen::Vector3d& target, int starts, double enough) const;

 private:
  const Body& body_;
  int tip_;
  const SelfCollision& collision_;
  Eigen::VectorXd lower_, upper_;
  std::vector<double> joints_;  // [samples x dof]
  std::vector<Eigen::Vector3d> tips_;
};

}  // namespace hbr
