#include "models/robot/body/capsules.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace hbr::inline robots {
namespace {

// A capsule about a box: along its longest edge, as thick as the mean of the other two.
struct Rounded {
  int axis;
  double half, radius;
};
Rounded rounded(const Eigen::Vector3d& edges) {
  int axis = 0;
  const double longest = edges.maxCoeff(&axis), radius = (edges.sum() - longest) / 4;
  return {axis, std::max(0., longest / 2 - radius), radius};
}

Eigen::Vector3d edges_of(const Visual& visual) {
  switch (visual.kind) {
    case Visual::Kind::box:
      return visual.size;
    case Visual::Kind::cylinder:
      return {2 * visual.size[0], 2 * visual.size[0], visual.size[2]};
    case Visual::Kind::capsule:
      return {2 * visual.size[0], 2 * visual.size[0], visual.size[2] + 2 * visual.size[0]};
    default:  // a sphere
      return Eigen::Vector3d::Constant(2 * visual.size[0]);
  }
}

constexpr double kFoam = 50;         // kg / m^3
constexpr double kLeastMass = 1e-9;  // kg

// From a link's frame to those of the links that hang on it, half as thick as long.
std::vector<Capsule> rods_of(const RobotModel& model, int link) {
  std::vector<Capsule> rods;
  for (const Joint& joint : model.joints) {
    const Eigen::Vector3d middle = joint.origin.translation() / 2;
    if (joint.parent == link && !middle.isZero()) rods.push_back({link, middle, middle, middle.norm() / 2});
  }
  return rods;
}

}  // namespace

std::vector<Capsule> capsules_of(const RobotModel& model, int link) {
  const Link& body = model.links[link];
  std::vector<Capsule> result;
  const auto add = [&](const Eigen::Isometry3d& pose, const Eigen::Vector3d& edges) {
    const Rounded shape = rounded(edges);
    result.push_back({link, pose.translation(),
                      pose.linear() * Eigen::Vector3d::Unit(shape.axis) * shape.half, shape.radius});
  };
  for (const Visual& visual : body.visuals)
    if (visual.kind != Visual::Kind::mesh) add(visual.pose, edges_of(visual));
  if (!result.empty() || !body.inertial) return result;
  // A solid box of mass m has the moment m (b^2 + c^2) / 12 about its edge a.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(body.inertial->inertia);
  const Eigen::Vector3d moments = principal.eigenvalues();
  const double mass = body.inertial->mass;
  const Eigen::Vector3d edges =
      (6 / std::max(mass, kLeastMass) * (moments.sum() - 2 * moments.array())).cwiseMax(0).sqrt();
  const std::vector<Capsule> rods = rods_of(model, link);
  if (mass < kFoam * edges.prod() && !rods.empty()) return rods;
  if (mass < kLeastMass) return {};
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = body.inertial->centre;
  pose.linear() = principal.eigenvectors();
  add(pose, edges);
  return result;
}

// Ericson, Real-Time Collision Detection, section 5.1.9: the segments a + s u and b + t v, s and t in [-1,
// 1].
double squared_distance(const Capsule& first, const Capsule& second) {
  const Eigen::Vector3d &u = first.half, &v = second.half, r = first.middle - second.middle;
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v), ur = u.dot(r), vr = v.dot(r);
  const double determinant = uu * vv - uv * uv;
  const auto within = [](double x) { return std::clamp(x, -1., 1.); };
  double s = determinant > 1e-12 * uu * vv ? within((uv * vr - vv * ur) / determinant) : 0;
  double t = vv > 0 ? (uv * s + vr) / vv : 0;
  if (std::abs(t) > 1 || vv == 0) {
    t = within(t);
    s = uu > 0 ? within((uv * t - ur) / uu) : 0;
  }
  return (r + s * u - t * v).squaredNorm();
}

}  // namespace hbr::inline robots
