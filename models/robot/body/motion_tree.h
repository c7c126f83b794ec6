// Where parts are that hang on each other, and their equations of motion, by recursion (R. Featherstone,
// Rigid Body Dynamics Algorithms, 2008: composite rigid bodies, recursive Newton-Euler). A part costs the
// same however many there are, and only joints of which one carries the other have a common entry in the mass
// matrix.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "models/robot/description/parts.h"

namespace hbr::inline robots {

// mass * accelerations + bias = torques: what a body obeys at its joints and speeds. The bias are the torques
// that hold it against gravity and against centrifugal and Coriolis forces.
struct Equations {
  Eigen::MatrixXd mass;  // [dof x dof], kg m^2 (kg for prismatic joints)
  Eigen::VectorXd bias;  // [dof], N m (N)
};

// A force and its moment about the origin of the root link's frame, N and N m.
struct Wrench {
  Eigen::Vector3d moment, force;
};

class MotionTree {
 public:
  // The part `ground` stands still at `pose`; joints on the way from there to part 0 move their parents.
  MotionTree(const RobotModel& model, const Parts& parts, int ground, const Eigen::Isometry3d& pose,
             Eigen::Index dof);

  // Where a point of a part is at these joints [dof], in the root link's frame, m; with its derivative by the
  // joints [3 x dof] where asked for. Only what carries the part is looked at. Thread-safe, as all below.
  Eigen::Vector3d place(int part, const Eigen::Vector3d& point, const double* joints,
                        Eigen::Matrix3Xd* slopes = nullptr) const;

  // Every part's frame in the root link's, at these joints [dof].
  std::vector<Eigen::Isometry3d> poses(const double* joints) const;

  // At these joints and speeds [dof] under uniform gravity, m/s^2.
  void equations(const Eigen::VectorXd& joints, const Eigen::VectorXd& speeds, const Eigen::Vector3d& gravity,
                 Equations& out) const;

  // What the ground gives to the part that stands still, so that the others have these accelerations [dof].
  Wrench reaction(const Eigen::VectorXd& joints, const Eigen::VectorXd& speeds,
                  const Eigen::VectorXd& accelerations, const Eigen::Vector3d& gravity) const;

 private:
  // A part that moves, hung on one before it in this list; -1 is the ground.
  struct Limb {
    int part, on;
    bool reversed;  // the joint's child carries its parent
    bool slides;
    Eigen::Isometry3d origin;  // of the joint, in the frame of its parent
    Eigen::Vector3d axis;
    int coordinate;
    double multiplier, offset;  // position of the joint: multiplier * coordinate + offset
    double mass;
    Eigen::Vector3d centre;   // of mass, in the part's frame
    Eigen::Matrix3d inertia;  // about the centre, in the part's frame
  };

  // The limb's frame, and the axis of its joint, where what carries it is so.
  static Eigen::Isometry3d pose_of(const Limb& limb, double position, const Eigen::Isometry3d& carrier);
  static Eigen::Vector3d axis_of(const Limb& limb, const Eigen::Isometry3d& child);

  struct MovingLimb;
  // Every limb as it moves, with the forces on itself alone; without accelerations those of the joints are 0.
  std::vector<MovingLimb> moved(const Eigen::VectorXd& joints, const Eigen::VectorXd& speeds,
                                const Eigen::VectorXd* accelerations, const Eigen::Vector3d& gravity) const;

  Eigen::Isometry3d pose_;
  double ground_mass_;                      // of the part that stands still
  Eigen::Vector3d ground_centre_;           // of that mass
  std::vector<Limb> limbs_;                 // carriers before what they carry
  std::vector<std::vector<int>> carriers_;  // of each part: the limbs from the ground to it, its own the last
  Eigen::Index dof_;
};

}  // namespace hbr::inline robots
