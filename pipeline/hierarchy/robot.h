// A robot that holds a pen: an immutable body that maps joint angles to the pen's position.
#pragma once

#include <Eigen/Core>
#include <string>

namespace hbr::inline hierarchy {

// Where the pen is, in the drawing frame: the planar arm's workspace, centred at its base, in metres. A robot
// that draws on a plane of its own space maps that plane onto the frame by a similarity.
struct Pen {
  Eigen::Vector2d position;  // m, in the drawing frame
  double off_plane = 0;  // m, signed distance from the drawing plane, in the robot's own scale; 0 for the arm
};

class Robot {
 public:
  virtual ~Robot() = default;
  virtual std::string name() const = 0;
  // Joint limits [dof], rad, or m where a joint slides; the number of joints is their size.
  virtual const Eigen::VectorXd& lower() const = 0;
  virtual const Eigen::VectorXd& upper() const = 0;
  virtual std::string unit(Eigen::Index /*joint*/) const { return "rad"; }
  // Pen of each configuration: joints [n x dof] in radians, row-major; `pens` has n entries. Thread-safe.
  virtual void pens(Eigen::Index n, const double* joints, Pen* pens) const = 0;
  // How far from the drawing plane a pen may be that draws, m.
  virtual double off_plane_tolerance() const { return 0; }
  // Whether a configuration [dof] runs neither into itself nor into the drawing area [-half_side,
  // half_side]^2, m. Thread-safe.
  virtual bool clear(const double* /*joints*/, double /*half_side*/) const { return true; }

  Eigen::Index dof() const { return lower().size(); }
};

}  // namespace hbr::inline hierarchy
