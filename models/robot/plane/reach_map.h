// Where a robot's tip can be, as a grid of cells: a quick, coarse answer to how near it gets to a place of a
// board that faces some way.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "models/robot/plane/clearance.h"
#include "pipeline/core/parallel.h"
#include "pipeline/core/random.h"

namespace hbr::inline robots {

class ReachMap {
 public:
  // Fills the cells that the tip comes to in `samples` configurations drawn within the limits: for each
  // direction in which a board may face (board_collision.h), those which leave an endless board there alone.
  // `margin` as for Reach. Throws InputError where no configuration is free, and where
  // the joints move the tip along a curve only.
  ReachMap(const Body& body, int tip, const Clearance& clearance, int samples, double margin, Seed seed,
           Workers& workers);

  double cell() const { return cell_; }                    // m, its edge
  const Eigen::AlignedBox3d& box() const { return box_; }  // of all the places, m

  // Unit: the direction in which the places of the tip differ least.
  const Eigen::Vector3d& flattest() const { return flattest_; }

  // m, from the cell of a place to the nearest one that is filled for boards which face in that direction: 0
  // in a filled cell.
  double distance(const Eigen::Vector3d& place, int facing) const;

 private:
  void spread(std::vector<double>& squared) const;
  Eigen::Vector3i cell_of(const Eigen::Vector3d& place) const;
  std::size_t index(const Eigen::Vector3i& c) const {
    return (static_cast<std::size_t>(c[2]) * size_[1] + c[1]) * size_[0] + c[0];
  }

  Eigen::AlignedBox3d box_;
  Eigen::Vector3d flattest_;
  double cell_ = 0;
  Eigen::Vector3i size_;         // cells
  std::vector<float> distance_;  // [directions x cells] of each to the nearest filled one, in cells
};

}  // namespace hbr::inline robots
