// Which masses a body can have, and which of a robot's description no body has.
//
// Public descriptions hold many that no body has: cameras of a mass without inertia, moments whose sum is off
// by rounding, inertias in other units. What is joined rigidly is one body, so a link's own numbers may be
// impossible where their sum is not; and who only draws needs no masses.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace hbr::inline robots {

struct RobotModel;

struct MassFault {
  enum class Kind {
    none,
    rounded,      // a moment larger than the sum of the other two, by at most 1 %
    lopsided,     // by more: it can move, but nothing moves like it
    not_positive  // no mass, or a moment that is not above 0
  };
  Kind kind = Kind::none;
  std::string why = {};  // "principal moments of inertia 1, 1, 2.5 kg m^2: no body has ..."
};

// Of a mass (kg) and an inertia (kg m^2) about a centre that lies `centre` (m) from the origin of the frame
// in which they were added up; that scales what counts as 0.
MassFault mass_fault(double mass, const Eigen::Vector3d& centre, const Eigen::Matrix3d& inertia);

// The inertia nearest to it, by its principal moments, that a body may have.
Eigen::Matrix3d nearest_possible(const Eigen::Matrix3d& inertia);

// One line for each kind of fault that does not keep a robot from drawing, none for a sound robot: links
// whose sum with what they are joined to is a body's, moments off by rounding, bodies whose dynamics are
// refused.
std::vector<std::string> mass_oddities(const RobotModel& model);

}  // namespace hbr::inline robots
