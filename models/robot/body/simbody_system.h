// Parts as a Simbody multibody system. Only the files of Body include it: it sees Simbody, and is compiled as
// C++17 with assertions (CMakeLists.txt).
#pragma once

#include <Simbody.h>

#include <string>
#include <vector>

#include "models/robot/description/parts.h"

namespace hbr::inline robots {

inline SimTK::Vec3 vec3(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }
inline Eigen::Vector3d eigen(const SimTK::Vec3& v) { return {v[0], v[1], v[2]}; }
Eigen::Isometry3d eigen(const SimTK::Transform& t);

// Which links and joints become which Simbody bodies.
struct SystemPlan : Parts {
  int ground = 0;                                          // the part that stands still
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  // of it
  std::string impossible = {};  // why nothing moves by these masses; "" where something can
};

// A System and its State; used by one thread at a time.
struct SimbodySystem {
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter{system};
  std::vector<SimTK::MobilizedBody> bodies;  // of each part
  std::vector<int> slots;                    // of each part's joint: its place among the state's coordinates
  SimTK::State state;

  // A tree that grows from the part that stands still: joints on the way from there to the root are built
  // from their child to their parent, and mean the same.
  SimbodySystem(const RobotModel& model, const SystemPlan& plan);

  // joints [dof]
  void pose(const SystemPlan& plan, const double* joints);

 private:
  SimTK::MobilizedBody mobilise(const RobotModel& model, const SystemPlan& plan, int joint_of, int from,
                                int to);
};

}  // namespace hbr::inline robots
