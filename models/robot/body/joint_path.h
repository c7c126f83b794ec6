// Way-points of joints as a smooth movement from rest to rest.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace hbr::inline robots {

// When a movement passes its way-points, seconds from 0: between two of them the pen keeps the pace [m/s] and
// no joint turns faster than joint_pace [rad/s] on the average. pen [n x 2] in metres, joints [n x dof] in
// radians, both row-major.
std::vector<double> times_at_pace(const std::vector<float>& pen, const std::vector<double>& joints,
                                  double pace, double joint_pace);

// The uniform cubic B-spline over the points of the polygon through the way-points that lie `smoothing`
// seconds apart. Positions, speeds and accelerations are continuous, the movement stays among its way-points
// (within their convex hull, so within the joints' limits), begins at the first, ends at the last, and rests
// at both.
class JointPath {
 public:
  struct Point {
    Eigen::VectorXd position, velocity, acceleration;  // rad, rad/s, rad/s^2
  };

  // joints [n x dof], row-major, n > 0; times [n], ascending from 0.
  JointPath(const std::vector<double>& joints, const std::vector<double>& times, double smoothing);

  double duration() const { return smoothing_ * static_cast<double>(control_.cols() - 3); }  // s, above 0
  Eigen::Index dof() const { return control_.rows(); }
  // Before the start and after the end it rests there.
  Point at(double time) const;

 private:
  Eigen::MatrixXd control_;  // [dof x points]
  double smoothing_;
};

}  // namespace hbr::inline robots
