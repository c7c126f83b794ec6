// A robot as a multibody system: any URDF, posed by the joints that are asked for. Simbody builds it, refuses
// what is none, and knows its mass and what its joints' frames are. Where its links are, which inverse
// kinematics and every child of a search ask for, and the equations of motion, which servos ask for at every
// step, are recursions of our own (motion_tree.h), held against Simbody's by tests.
//
// The body is immutable. Every thread that asks it something works on a System and State of its own, taken
// from a pool, so all members may be called from any thread at once. Only simbody_system.h sees Simbody's
// headers.
#pragma once

#include <Eigen/Geometry>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "models/robot/body/motion_tree.h"
#include "models/robot/body/moving_parts.h"
#include "models/robot/description/robot_model.h"

namespace hbr::inline robots {

struct SystemPlan;

class Body {
 public:
  // `moving` names the joints that are coordinates, in this order; they may not be fixed or follow another.
  // Joints that follow one of them move with it. Every other joint is locked where `rest` says (rad or m), at
  // 0 without a word there, brought within its range (RobotModel::range) and, where it turns without end,
  // within half a turn of 0. Throws InputError for unknown or unfit joints. The link `ground` stands still,
  // where it is in the posture `rest`; "": the root link.
  Body(RobotModel model, std::vector<std::string> moving, const std::map<std::string, double>& rest = {},
       const std::string& ground = "");
  ~Body();
  Body(const Body&) = delete;
  Body& operator=(const Body&) = delete;

  const RobotModel& model() const { return model_; }
  const std::vector<std::string>& moving() const { return moving_; }
  // Of each moving joint its range [dof], rad or m.
  const Eigen::VectorXd& lower() const { return lower_; }
  const Eigen::VectorXd& upper() const { return upper_; }
  Eigen::Index dof() const { return lower_.size(); }

  // The moving joints where `rest` has them, as above [dof].
  Eigen::VectorXd posture(const std::map<std::string, double>& rest) const;

  // The whole robot's, kg; and its centre in the root link's frame, m. joints [dof].
  double mass() const;
  Eigen::Vector3d centre_of_mass(const Eigen::VectorXd& joints) const;

  // Places and directions below are in the root link's frame; where another link stands still, in that which
  // the root link has in the posture `rest`.

  // Every link's frame in the root link's, by index in model().links.
  std::vector<Eigen::Isometry3d> link_poses(const Eigen::VectorXd& joints) const;

  // Origins of `link` in the root link's frame, for n configurations [n x dof], row-major; m.
  void positions(int link, Eigen::Index n, const double* joints, Eigen::Vector3d* out) const;

  // The same for one configuration, with its derivative by the joints [3 x dof] where asked for.
  Eigen::Vector3d position(int link, const double* joints, Eigen::Matrix3Xd* jacobian = nullptr) const;

  // Why nothing moves this body by forces, a part of it having a mass that no body has; "" where something
  // can.
  const std::string& impossible_dynamics() const;

  // The equations of motion at these joints and speeds [dof] under uniform gravity, m/s^2. Throws InputError
  // with the reason where there are none.
  void equations(const Eigen::VectorXd& joints, const Eigen::VectorXd& speeds, const Eigen::Vector3d& gravity,
                 Equations& out) const;

  // What the ground gives to the link that stands still, so that the joints have these accelerations [dof].
  // Throws as equations() does.
  Wrench reaction(const Eigen::VectorXd& joints, const Eigen::VectorXd& speeds,
                  const Eigen::VectorXd& accelerations, const Eigen::Vector3d& gravity) const;

  // The coordinates that move this link.
  std::vector<bool> moves(int link) const;

  // Of a body whose root link stands still.
  MovingParts moving_parts() const;

 private:
  struct Pool;  // of systems that no thread uses
  class Lease;
  void stand_on(int link, const std::map<std::string, double>& rest);

  RobotModel model_;
  std::vector<std::string> moving_;
  Eigen::VectorXd lower_, upper_;
  std::unique_ptr<SystemPlan> plan_;
  std::unique_ptr<MotionTree> tree_;
  std::unique_ptr<Pool> pool_;
};

}  // namespace hbr::inline robots
