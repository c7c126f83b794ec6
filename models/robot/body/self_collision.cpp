#include "models/robot/body/self_collision.h"

#include <algorithm>

namespace hbr::inline robots {
namespace {

bool touch(const Capsule& a, const Capsule& b) {
  const double far = a.reach() + b.reach(), near = a.radius + b.radius;
  return (a.middle - b.middle).squaredNorm() <= far * far && squared_distance(a, b) < near * near;
}

}  // namespace

SelfCollision::SelfCollision(const Body& body) {
  const RobotModel& model = body.model();
  std::vector<std::vector<bool>> moved_by;
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    const int link = static_cast<int>(i);
    moved_by.push_back(body.moves(link));
    for (const Capsule& capsule : capsules_of(model, link)) capsules_.push_back(capsule);
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
      if (moved_by[k] != moved_by[l] && !connected(k, l) && !connected(l, k) &&
          !touch(capsules_[a].at(poses[k]), capsules_[b].at(poses[l])))
        pairs_.push_back({a, b});
    }
}

bool SelfCollision::collides(const std::vector<Eigen::Isometry3d>& poses) const {
  std::vector<Capsule> placed;
  placed.reserve(capsules_.size());
  for (const Capsule& capsule : capsules_) placed.push_back(capsule.at(poses[capsule.link]));
  return std::ranges::any_of(pairs_, [&](const Pair& pair) { return touch(placed[pair.a], placed[pair.b]); });
}

}  // namespace hbr::inline robots
