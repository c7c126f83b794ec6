// The drawing area and the ranges of the layers' descriptors: metres to [0, 1] and back.
#pragma once

#include <Eigen/Core>

namespace hbr::inline hierarchy {

// Which displacements a line may ask for: those of at most rho, or also the corners of the square around
// them.
enum class LineRange { kDisc, kSquare };

struct Frame {
  double half_side;     // L, m: the drawing area is [-L, L]^2
  double longest_line;  // rho, m: the longest displacement that a line may ask for along an axis
  LineRange line_range = LineRange::kDisc;

  // Layer 1: position P [m] <-> descriptor.
  Eigen::Vector2d point_descriptor(const Eigen::Vector2d& p) const {
    return (p.array() + half_side) / (2 * half_side);
  }
  Eigen::Vector2d point(const Eigen::Vector2d& descriptor) const {
    return descriptor.array() * 2 * half_side - half_side;
  }
  // The same for a displacement, which has no origin.
  Eigen::Vector2f point_step(const Eigen::Vector2d& displacement) const {
    return (displacement / (2 * half_side)).cast<float>();
  }
  // Layer 2: displacement V [m] <-> descriptor.
  Eigen::Vector2d line_descriptor(const Eigen::Vector2d& v) const {
    return v.array() / (2 * longest_line) + 0.5;
  }
  Eigen::Vector2d line(const Eigen::Vector2d& descriptor) const {
    return (descriptor.array() - 0.5) * 2 * longest_line;
  }
};

// The vector, shortened to `most` where it is longer.
inline Eigen::Vector2d at_most(const Eigen::Vector2d& v, double most) {
  const double length = v.norm();
  return length > most ? Eigen::Vector2d(v * (most / length)) : v;
}

}  // namespace hbr::inline hierarchy
