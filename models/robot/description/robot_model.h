// A robot's description as plain data: links, joints, masses and what they look like, read from a URDF.
//
// Units: metres, radians (metres for prismatic joints), kilograms. Frames as in the URDF: a joint's child
// link has its frame at the joint; a joint's axis and origin are constant.
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hbr::inline robots {

struct Inertial {
  double mass;              // kg, > 0
  Eigen::Vector3d centre;   // of mass, in the link's frame
  Eigen::Matrix3d inertia;  // kg m^2, about the centre of mass, along the link's axes
};

struct Visual {
  enum class Kind { mesh, box, cylinder, capsule, sphere };
  Kind kind;
  Eigen::Isometry3d pose;  // in the link's frame
  std::string mesh;        // as written in the URDF
  // Box: its edges; cylinder and capsule: radius, radius, length (of the straight part); sphere: radius;
  // mesh: its scale, which may mirror; the others are above 0.
  Eigen::Vector3d size;
  std::optional<Eigen::Vector3f> colour;  // red, green, blue in [0, 1]
};

struct Link {
  std::string name;
  std::optional<Inertial> inertial;
  std::vector<Visual> visuals;
  int joint = -1;                   // the joint it hangs on; -1 for the root
  bool weightless_inertia = false;  // its <inertial> has an inertia but no mass: it counts as a frame
};

struct Joint {
  enum class Kind { fixed, revolute, continuous, prismatic };
  std::string name;
  Kind kind;
  int parent, child;         // links
  Eigen::Isometry3d origin;  // of the child's frame at 0, in the parent's
  Eigen::Vector3d axis;      // unit, in the child's frame
  double lower, upper;       // [-pi, pi] for a continuous joint
  double effort, velocity;   // N m or N, rad/s or m/s; 0 where the URDF names none
  int mimic = -1;            // the joint, moving by itself, that it follows: multiplier * position + offset
  double multiplier = 1, offset = 0;

  // The child's frame in the parent's when the joint stands at `position`.
  Eigen::Isometry3d motion(double position) const;
  // The same place within half a turn of 0, for a continuous joint; else the position itself.
  double within_a_turn(double position) const;
};

struct RobotModel {
  std::string name;
  std::filesystem::path path;    // of the URDF
  std::vector<Link> links;       // the root first, parents before children
  std::vector<Joint> joints;     // joints[i].child == i + 1
  std::vector<std::string> odd;  // lines, with their places, of what was read otherwise than it is written

  // Throw InputError, with a list of what there is, for an unknown name.
  int link(const std::string& link_name) const;
  int joint(const std::string& joint_name) const;
  // The least and the greatest position of a joint, by its index: its limits, narrowed so that joints that
  // follow it stay within theirs. A follower whose limits leave the joint no room to move does not count.
  std::pair<double, double> range(int joint_index) const;
  // Joints that move and follow no other, in the order of `joints`.
  std::vector<std::string> independent_joints() const;
};

// Reads a URDF. Whatever its geometry allows is read: shapes of no size, masses below 0, joints that can't
// move as they say and the like are left out or read as what they mostly mean, with a line in `odd`. Throws
// InputError, with file, line, what was expected and found, for a file that is missing, not XML or without a
// robot, text that is no number, numbers that nothing has, a joint type that no URDF has, links that are not
// one tree, and joints that follow each other in a loop.
RobotModel load_urdf(const std::filesystem::path& path);

}  // namespace hbr::inline robots
