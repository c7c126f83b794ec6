// Whether a robot runs into itself: coarse, with a few capsules around each link.
#pragma once

#include <vector>

#include "models/simbody/body.h"

namespace hbr {

class SelfCollision {
 public:
  // A link's shapes are its visual boxes, cylinders and spheres as capsules; where it has none (meshes say
  // nothing here), the capsule of the solid box that has its mass and inertia. Never in each other's way are
  // links that move as one, that a joint connects, or whose shapes touch at rest (the moving joints at 0, or
  // at the limit next to it). `body` must outlive it.
  explicit SelfCollision(const Body& body);

  // joints [dof]. Thread-safe.
  bool collides(const double* joints) const;

  // Whether a link that no moving joint moves comes through a disc or lies behind it; the normal (unit)
  // points to where the robot should be.
  bool pierces(const Eigen::Vector3d& centre, const Eigen::Vector3d& normal, double radius) const;

 private:
  // All that is within `radius` of the segment from `middle` - `half` to `middle` + `half`, m.
  struct Capsule {
    int link;
    Eigen::Vector3d middle, half;
    double radius;
    double reach() const { return half.norm() + radius; }
  };
  struct Pair {
    int a, b;  // capsules
  };
  static std::vector<Capsule> shapes(const RobotModel& model, int link);
  bool touch(const Pair& pair, const std::vector<Eigen::Isometry3d>& poses) const;

  const Body& body_;
  std::vector<Capsule> capsules_;
  std::vector<Pair> pairs_;
  std::vector<Capsule> still_;  // in the root link's frame
};

}  // namespace hbr
