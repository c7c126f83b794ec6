// How near a robot's tip can come to a point: inverse kinematics within the joints' limits.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "models/robot/plane/clearance.h"
#include "pipeline/core/random.h"

namespace hbr::inline robots {

class Reach {
 public:
  struct Nearest {
    Eigen::VectorXd joints;  // within the limits, kept off them by the margin
    Eigen::Vector3d gap;  // m, from the tip to the target: its length's gradient by the target is gap / |gap|
  };

  // Draws `samples` configurations and keeps those that run into nothing; inverse kinematics starts from
  // those whose tip is nearest to the target. `margin` in [0, 0.5): the share of a joint's range that is left
  // unused at either end.
  Reach(const Body& body, int tip, const Clearance& clearance, int samples, double margin, Seed seed);

  // Levenberg-Marquardt (Ceres, bounded) until it arrives within `enough` metres: from the nearest `starts`
  // samples that leave an endless board alone which faces about as this one (board_collision.h), then from as
  // many of all. What runs into the robot itself or into the board does not count; where all do, the answer
  // is the nearest of the first samples. Thread-safe.
  Nearest nearest(const Eigen::Vector3d& target, const Board& board, int starts, double enough) const;

  // The same from the joints where a target near this one was reached, and from there alone; nothing where
  // that runs into the robot itself or into the board.
  std::optional<Nearest> continued(const Eigen::Vector3d& target, const Board& board,
                                   const Eigen::VectorXd& before, double enough) const;

  // The nearest to a target whatever the robot runs into there, from the nearest `starts` of all samples.
  Nearest nearest_of_any(const Eigen::Vector3d& target, int starts, double enough) const;

 private:
  // Of the samples those with the tip nearest to the target, the nearest first.
  std::vector<int> closest(const std::vector<int>& samples, const Eigen::Vector3d& target, int count) const;
  Eigen::VectorXd sample(int i) const {
    return Eigen::Map<const Eigen::VectorXd>(&joints_[i * body_.dof()], body_.dof());
  }
  Eigen::VectorXd descend(const Eigen::Vector3d& target, Eigen::VectorXd joints, double enough) const;

  const Body& body_;
  int tip_;
  const Clearance& clearance_;
  Eigen::VectorXd lower_, upper_;
  std::vector<double> joints_;  // [samples x dof]
  std::vector<Eigen::Vector3d> tips_;
  std::array<std::vector<int>, kDirections> facing_;  // samples that leave a board alone which faces so
  std::vector<int> all_;
};

}  // namespace hbr::inline robots
