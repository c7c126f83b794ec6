#include "models/robot/body/chain.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/core/random.h"

namespace hbr::inline robots {
namespace {

using Coordinates = std::vector<double>;

Chain chain_to(const RobotModel& model, int link) {
  std::vector<int> joints;
  for (int at = link; model.links[at].joint >= 0; at = model.joints[model.links[at].joint].parent)
    joints.push_back(model.links[at].joint);
  Chain chain{model.links[link].name, {}, {}, {}, {}};
  Eigen::Isometry3d fixed = Eigen::Isometry3d::Identity();
  for (std::size_t k = joints.size(); k-- > 0;) {
    const Joint& joint = model.joints[joints[k]];
    if (joint.kind == Joint::Kind::fixed) {
      fixed = fixed * joint.origin;
      continue;
    }
    const int leading = joint.mimic < 0 ? joints[k] : joint.mimic;
    const Joint* leader = &model.joints[leading];
    const auto known = std::ranges::find(chain.leaders, leader);
    chain.steps.push_back({fixed, &joint, static_cast<int>(known - chain.leaders.begin())});
    if (known == chain.leaders.end()) {
      chain.leaders.push_back(leader);
      chain.ranges.push_back(model.range(leading));
    }
    fixed.setIdentity();
  }
  chain.tip = fixed.translation();
  return chain;
}

Coordinates random_posture(const Chain& chain, Rng& rng) {
  Coordinates at;
  for (const auto& [lower, upper] : chain.ranges) at.push_back(std::lerp(lower, upper, rng.uniform_double()));
  return at;
}

// Where a joint that moves the point `tip` of its child should stand for it to get farthest from `base`, both
// in the frame of `step.before`; what is farthest is in closed form for each kind of joint.
double farthest_position(const Joint& joint, const Eigen::Vector3d& base, const Eigen::Vector3d& tip,
                         double lower, double upper) {
  // In the child's frame at 0, of the squared distance from b = base there to the tip moved by the joint.
  const Eigen::Vector3d b = joint.origin.inverse() * base;
  const auto squared = [&](double position) {
    return ((joint.origin.inverse() * joint.motion(position)) * tip - b).squaredNorm();
  };
  const double ends = squared(lower) >= squared(upper) ? lower : upper;
  if (joint.kind == Joint::Kind::prismatic) return ends;
  // A turn by x changes it by -2 b . turned tip = c - p cos x - q sin x, greatest opposite to (p, q).
  const Eigen::Vector3d& a = joint.axis;
  const Eigen::Vector3d level = tip - a.dot(tip) * a;
  double best = std::atan2(-b.dot(a.cross(tip)), -b.dot(level));
  best += 2 * std::numbers::pi * std::ceil((lower - best) / (2 * std::numbers::pi));
  return best <= upper ? best : ends;
}

// One coordinate after the other is brought where the tip is farthest while the others stand.
class Climb {
 public:
  Climb(const Chain& chain, Coordinates start)
      : chain_(chain), at_(std::move(start)), steps_of_(chain.leaders.size()), base_(chain.base()) {
    for (std::size_t i = 0; i < chain.steps.size(); ++i) steps_of_[chain.steps[i].coordinate].push_back(i);
  }

  double top() {
    double distance = (chain_.tip_at(at_) - base_).norm();
    for (int sweep = 0; sweep < 200; ++sweep) {
      const double before = distance;
      distance = once();
      if (!(distance > before * (1 + 1e-10))) break;
    }
    return distance;
  }

 private:
  // Tips as each step's child sees them, by the coordinates as they are.
  std::vector<Eigen::Vector3d> tips() const {
    std::vector<Eigen::Vector3d> result(chain_.steps.size());
    Eigen::Vector3d tip = chain_.tip;
    for (std::size_t i = result.size(); i-- > 0;) {
      result[i] = tip;
      tip = Chain::motion(chain_.steps[i], at_) * tip;
    }
    return result;
  }

  double once() {
    std::vector<Eigen::Vector3d> tip = tips();
    Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
    for (std::size_t i = 0; i < chain_.steps.size(); ++i) {
      const Chain::Step& step = chain_.steps[i];
      const Joint& joint = *step.joint;
      const auto [lower, upper] = chain_.ranges[step.coordinate];
      if (steps_of_[step.coordinate].size() > 1) {
        if (steps_of_[step.coordinate][0] == i) {
          move_together(step.coordinate);
          tip = tips();
        }
      } else if (joint.multiplier != 0) {
        const double a = joint.multiplier * lower + joint.offset, b = joint.multiplier * upper + joint.offset;
        const double position = farthest_position(joint, (frame * step.before).inverse() * base_, tip[i],
                                                  std::min(a, b), std::max(a, b));
        at_[step.coordinate] = std::clamp((position - joint.offset) / joint.multiplier, lower, upper);
      }
      frame = frame * Chain::motion(step, at_);
    }
    return (frame * chain_.tip - base_).norm();
  }

  // A coordinate of several joints: the best of some positions, then nearer and nearer around it.
  void move_together(int coordinate) {
    const double lower = chain_.ranges[coordinate].first, upper = chain_.ranges[coordinate].second;
    double& at = at_[coordinate];
    double farthest = (chain_.tip_at(at_) - base_).norm(), best = at;
    const auto attempt = [&](double position) {
      at = std::clamp(position, lower, upper);
      const double distance = (chain_.tip_at(at_) - base_).norm();
      if (distance > farthest) farthest = distance, best = at;
    };
    constexpr int kPositions = 32;
    for (int k = 0; k <= kPositions; ++k)
      attempt(std::lerp(lower, upper, k / static_cast<double>(kPositions)));
    for (double off = (upper - lower) / kPositions; off > 1e-9; off /= 2)
      for (const double sign : {-1., 1.}) attempt(best + sign * off);
    at = best;
  }

  const Chain& chain_;
  Coordinates at_;
  std::vector<std::vector<std::size_t>> steps_of_;  // of each coordinate
  Eigen::Vector3d base_;
};

}  // namespace

Eigen::Vector3d Chain::tip_at(const std::vector<double>& coordinates) const {
  Eigen::Vector3d at = tip;
  for (std::size_t i = steps.size(); i-- > 0;) at = motion(steps[i], coordinates) * at;
  return at;
}

std::vector<Chain> chains_of(const RobotModel& model) {
  std::vector<bool> has_child(model.links.size());
  for (const Joint& joint : model.joints) has_child[joint.parent] = true;
  std::vector<Chain> result;
  for (std::size_t link = 0; link < model.links.size(); ++link) {
    if (has_child[link]) continue;
    Chain chain = chain_to(model, static_cast<int>(link));
    if (!chain.steps.empty()) result.push_back(std::move(chain));
  }
  return result;
}

double farthest_reach(const Chain& chain, int starts) {
  Coordinates zero;  // where many a robot is straight
  for (const auto& [lower, upper] : chain.ranges) zero.push_back(std::clamp(0., lower, upper));
  double farthest = Climb(chain, zero).top();
  Rng rng(Seed(1).child(chain.link));
  for (int start = 0; start < starts; ++start)
    farthest = std::max(farthest, Climb(chain, random_posture(chain, rng)).top());
  return farthest;
}

std::vector<Eigen::Vector3d> reached_points(const Chain& chain, int n) {
  Rng rng(Seed(2).child(chain.link));
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < n; ++i) points.push_back(chain.tip_at(random_posture(chain, rng)));
  return points;
}

}  // namespace hbr::inline robots
