#include "models/simbody/self_collision.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace hbr {
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
    default:  // a sphere
      return Eigen::Vector3d::Constant(2 * visual.size[0]);
  }
}

// Least squared distance between the segments a + s u and b + t v, s and t in [-1, 1] (Ericson, Real-Time
// Collision Detection, section 5.1.9).
double squared_distance(const Eigen::Vector3d& a, const Eigen::Vector3d& u, const Eigen::Vector3d& b,
                        const Eigen::Vector3d& v) {
  const Eigen::Vector3d r = a - b;
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

}  // namespace

std::vector<SelfCollision::Capsule> SelfCollision::shapes(const RobotModel& model, int link) {
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
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = body.inertial->centre;
  pose.linear() = principal.eigenvectors();
  add(pose, (6 / body.inertial->mass * (moments.sum() - 2 * moments.array())).cwiseMax(0).sqrt());
  return result;
}

SelfCollision::SelfCollision(const Body& body) : body_(body) {
  const RobotModel& model = body.model();
  std::vector<std::vector<bool>> moved_by;
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    const int link = static_cast<int>(i);
    moved_by.push_back(body.moves(link));
    for (const Capsule& capsule : shapes(model, link)) capsules_.push_back(capsule);
  }
  const auto connected = [&](int parent, int child) {
    const int joint = model.links[child].joint;
    return joint >= 0 && model.joints[joint].parent == parent;
  };
  const Eigen::VectorXd rest = body.lower().cwiseMax(0).cwiseMin(body.upper());
  const std::vector<Eigen::Isometry3d> poses = body.link_poses(rest);
  const int n = static_cast<int>(capsules_.size());
  for (int a = 0; a < n; ++a)
    for (int b = a + 1; b < n; ++b) {
      const int k = capsules_[a].link, l = capsules_[b].link;
      if (moved_by[k] != moved_by[l] && !connected(k, l) && !connected(l, k) && !touch({a, b}, poses))
        pairs_.push_back({a, b});
    }
  for (Capsule capsule : capsules_) {
    if (std::ranges::count(moved_by[capsule.link], true) > 0) continue;
    const Eigen::Isometry3d& pose = poses[capsule.link];
    capsule.middle = pose * capsule.middle;
    capsule.half = pose.linear() * capsule.half;
    still_.push_back(capsule);
  }
}

bool SelfCollision::touch(const Pair& pair, const std::vector<Eigen::Isometry3d>& poses) const {
  const Capsule &a = capsules_[pair.a], &b = capsules_[pair.b];
  const Eigen::Isometry3d &at = poses[a.link], &bt = poses[b.link];
  const Eigen::Vector3d p = at * a.middle, q = bt * b.middle;
  const double far = a.reach() + b.reach(), near = a.radius + b.radius;
  if ((p - q).squaredNorm() > far * far) return false;
  return squared_distance(p, at.linear() * a.half, q, bt.linear() * b.half) < near * near;
}

bool SelfCollision::pierces(const Eigen::Vector3d& centre, const Eigen::Vector3d& normal,
                            double radius) const {
  return std::ranges::any_of(still_, [&](const Capsule& c) {
    for (const double t : {-1., 0., 1.}) {
      const Eigen::Vector3d away = c.middle + t * c.half - centre;
      const double height = normal.dot(away);
      if (height < c.radius && (away - height * normal).norm() < radius + c.radius) return true;
    }
    return false;
  });
}

bool SelfCollision::collides(const double* joints) const {
  if (pairs_.empty()) return false;
  const std::vector<Eigen::Isometry3d> poses =
      body_.link_poses(Eigen::Map<const Eigen::VectorXd>(joints, body_.dof()));
  return std::ranges::any_of(pairs_, [&](const Pair& pair) { return touch(pair, poses); });
}

}  // namespace hbr
