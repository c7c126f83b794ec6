#include "models/robot/plane/posture_path.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "models/robot/plane/straighten_postures.h"

namespace hbr::inline robots {
namespace {

constexpr int kNear = 64;             // elites from which a place's inverse solutions start
constexpr std::size_t kCarried = 32;  // candidates of the place before, those of the shortest ways
constexpr double kSame = 0.01;        // rad: candidates as near to each other as this are one
constexpr double kJump = 0.5;      // rad: a larger turn between two places, and another way to hold the arm
constexpr double kTurn = 0.3;      // rad: between two places, towards another way to hold the arm
constexpr std::size_t kGoals = 3;  // such ways that a posture is turned to
constexpr double kAside = 1e-2;    // m: a pen so far aside half-way along a jump costs as much as 1 rad
constexpr double kDamping = 1e-6;  // m^2/rad^2: of inverse kinematics, against singular postures
constexpr int kRounds = 8;         // of straightening, each with more places kept as they were

struct Candidate {
  Eigen::VectorXd joints;
  double jumps = 0;  // rad^2, of the way to it: squares of the distances between configurations
  int from = -1;     // among the candidates of the place before
};
using Candidates = std::vector<Candidate>;

double distance_to(const RobotOnPlane& robot, const Eigen::Vector3d& target, const double* joints) {
  return (robot.body().position(robot.tip(), joints) - target).norm();
}

class PosturePath {
 public:
  PosturePath(const RobotOnPlane& robot, const PointLayer& points, const Trace& trace)
      : robot_(robot), points_(points), trace_(trace), enough_(robot.off_plane_tolerance() / 10) {
    for (Eigen::Index k = 0; k < trace.points(); ++k) targets_.push_back(robot.plane().to_robot(pen(k)));
  }

  std::vector<double> smoothest() const {
    std::vector<Candidates> places;
    for (Eigen::Index k = 0; k < trace_.points(); ++k) {
      places.push_back(candidates(k, places.empty() ? Candidates() : places.back()));
      if (k > 0) connect(places[k - 1], places[k], nullptr);
      sort(places[k]);
    }
    std::vector<Eigen::VectorXd> way = best_way(places);
    if (jumps(way)) way = without_jumps(places);
    const std::vector<double> found = row_by_row(straightened_where_possible(std::move(way)));
    return joint_travel(found, robot_.dof()) <= joint_travel(trace_.joints, robot_.dof()) ? found
                                                                                          : trace_.joints;
  }

 private:
  Eigen::Vector2d pen(Eigen::Index k) const { return {trace_.pen[2 * k], trace_.pen[2 * k + 1]}; }
  Eigen::VectorXd own(Eigen::Index k) const {
    return Eigen::Map<const Eigen::VectorXd>(&trace_.joints[k * robot_.dof()], robot_.dof());
  }
  std::vector<double> row_by_row(const std::vector<Eigen::VectorXd>& way) const {
    std::vector<double> joints;
    for (const Eigen::VectorXd& q : way) joints.insert(joints.end(), q.begin(), q.end());
    return joints;
  }

  // The best first, so that the first of the last place has the best way.
  static void sort(Candidates& place) { std::ranges::stable_sort(place, {}, &Candidate::jumps); }

  static std::vector<Eigen::VectorXd> best_way(const std::vector<Candidates>& places) {
    std::vector<Eigen::VectorXd> way;
    int at = 0;
    for (auto place = places.rbegin(); place != places.rend(); ++place) {
      way.push_back((*place)[at].joints);
      at = (*place)[at].from;
    }
    std::ranges::reverse(way);
    return way;
  }

  static bool jumps(const std::vector<Eigen::VectorXd>& way) {
    for (std::size_t k = 1; k < way.size(); ++k)
      if ((way[k] - way[k - 1]).norm() > kJump) return true;
    return false;
  }

  // With more candidates, from the first place to the last and back; the pen's way along a jump counts.
  std::vector<Eigen::VectorXd> without_jumps(std::vector<Candidates>& places) const {
    const auto pass = [&](Eigen::Index from, Eigen::Index to, bool explored) {
      const Eigen::Index step = from < to ? 1 : -1;
      for (Candidate& c : places[from]) c.jumps = 0;
      for (Eigen::Index k = from + step; k != to + step; k += step) {
        const Eigen::Vector3d middle = (targets_[k - step] + targets_[k]) / 2;
        if (explored) explore(places[k - step], k, places[k]);
        connect(places[k - step], places[k], &middle);
        sort(places[k]);
      }
    };
    const Eigen::Index last = trace_.points() - 1;
    pass(0, last, true);
    pass(last, 0, true);
    pass(0, last, false);
    return best_way(places);
  }

  Candidates candidates(Eigen::Index k, const Candidates& before) const {
    Candidates found{{own(k)}};
    for (std::size_t i = 0; i < std::min(kCarried, before.size()); ++i) add(before[i].joints, k, found);
    for (const std::int32_t elite : elites_near(pen(k)))
      add(Eigen::Map<const Eigen::VectorXd>(points_.joints(elite), robot_.dof()), k, found);
    return found;
  }

  void add(const Eigen::VectorXd& start, Eigen::Index k, Candidates& place) const {
    const Eigen::VectorXd joints = inverse(start, targets_[k]);
    for (const Candidate& other : place)
      if ((other.joints - joints).norm() < kSame) return;
    if (possible(joints, k)) place.push_back({joints});
  }

  // Carries candidates of a place beside, the best of each way to hold the arm: as they are, and on their way
  // to those that are there already, so that a jump may be made of small turns.
  void explore(const Candidates& beside, Eigen::Index k, Candidates& place) const {
    std::vector<Eigen::VectorXd> goals;
    for (const Candidate& c : place) goals.push_back(c.joints);
    std::vector<Eigen::VectorXd> starts;
    for (const Candidate& c : beside)
      if (starts.size() < kCarried) add_if_apart(c.joints, starts);
    for (const Eigen::VectorXd& start : starts) add(start, k, place);
    for (const Eigen::VectorXd& start : starts) {
      std::ranges::sort(goals, {}, [&](const Eigen::VectorXd& goal) { return (goal - start).norm(); });
      std::vector<Eigen::VectorXd> taken;
      for (auto goal = goals.begin(); goal != goals.end() && taken.size() < kGoals; ++goal) {
        const double far = (*goal - start).norm();
        if (far > kTurn && add_if_apart(*goal, taken)) add(start + kTurn / far * (*goal - start), k, place);
      }
    }
  }

  static bool add_if_apart(const Eigen::VectorXd& joints, std::vector<Eigen::VectorXd>& chosen) {
    const auto alike = [&](const Eigen::VectorXd& other) { return (other - joints).norm() < kJump; };
    if (std::ranges::any_of(chosen, alike)) return false;
    chosen.push_back(joints);
    return true;
  }

  std::vector<std::int32_t> elites_near(const Eigen::Vector2d& place) const {
    std::vector<std::pair<double, std::int32_t>> all(points_.size());
    for (std::int32_t i = 0; i < points_.size(); ++i)
      all[i] = {(points_.position(i) - place).squaredNorm(), i};
    const std::size_t n = std::min<std::size_t>(kNear, all.size());
    std::ranges::partial_sort(all, all.begin() + static_cast<std::ptrdiff_t>(n));
    std::vector<std::int32_t> near;
    for (std::size_t i = 0; i < n; ++i) near.push_back(all[i].second);
    return near;
  }

  // Damped least squares from `joints` on; a joint that stands at its limit leaves the work to the others.
  Eigen::VectorXd inverse(Eigen::VectorXd joints, const Eigen::Vector3d& target) const {
    Eigen::Matrix3Xd slopes;
    for (int i = 0; i < 20; ++i) {
      const Eigen::Vector3d off = target - robot_.body().position(robot_.tip(), joints.data(), &slopes);
      if (off.norm() <= enough_ / 10) break;
      Eigen::VectorXd step;
      for (bool blocked = true; blocked;) {
        const Eigen::Matrix3d square = slopes * slopes.transpose() + kDamping * Eigen::Matrix3d::Identity();
        step = slopes.transpose() * square.ldlt().solve(off);
        blocked = false;
        for (Eigen::Index k = 0; k < joints.size(); ++k) {
          const bool at_limit = step[k] > 0 ? joints[k] >= robot_.upper()[k] : joints[k] <= robot_.lower()[k];
          if (step[k] == 0 || !at_limit) continue;
          slopes.col(k).setZero();
          blocked = true;
        }
      }
      joints = (joints + step).cwiseMax(robot_.lower()).cwiseMin(robot_.upper());
    }
    return joints;
  }

  bool possible(const Eigen::VectorXd& joints, Eigen::Index k) const {
    return distance_to(robot_, targets_[k], joints.data()) <= enough_ &&
           robot_.clear(joints.data(), points_.frame().half_side);
  }

  // Each candidate of a place with the way to it through the candidates before. `middle`, where it is given:
  // between the two places; how far the pen is from it half-way along a jump counts.
  void connect(const Candidates& before, Candidates& place, const Eigen::Vector3d* middle) const {
    for (Candidate& to : place) {
      to.jumps = std::numeric_limits<double>::infinity();
      for (const bool jump : {false, true})
        for (std::size_t i = 0; i < before.size(); ++i) {
          const double turned = (to.joints - before[i].joints).squaredNorm();
          double jumps = before[i].jumps + turned;
          if (jump != (turned > kJump * kJump) || jumps >= to.jumps) continue;
          if (jump && middle) {
            const Eigen::VectorXd half = (to.joints + before[i].joints) / 2;
            jumps += std::pow(distance_to(robot_, *middle, half.data()) / kAside, 2);
            if (jumps >= to.jumps) continue;
          }
          to.jumps = jumps;
          to.from = static_cast<int>(i);
        }
    }
  }

  // Places where the straightened way can't be had keep what they have, and the others are straightened
  // again.
  std::vector<Eigen::VectorXd> straightened_where_possible(const std::vector<Eigen::VectorXd>& way) const {
    std::vector<bool> kept(way.size(), false);
    for (int round = 0; round < kRounds; ++round) {
      std::vector<Eigen::VectorXd> straight = straightened(robot_, targets_, way, kept);
      bool all = true;
      for (std::size_t k = 0; k < way.size(); ++k) {
        if (kept[k] || possible(straight[k], static_cast<Eigen::Index>(k))) continue;
        kept[k] = true;
        all = false;
      }
      if (all) return straight;
    }
    return way;
  }

  const RobotOnPlane& robot_;
  const PointLayer& points_;
  const Trace& trace_;
  double enough_;  // m
  std::vector<Eigen::Vector3d> targets_;
};

}  // namespace

double joint_travel(const std::vector<double>& joints, Eigen::Index dof) {
  double travel = 0;
  for (std::size_t at = static_cast<std::size_t>(dof); at < joints.size(); at += dof) {
    const Eigen::Map<const Eigen::VectorXd> before(&joints[at - dof], dof), after(&joints[at], dof);
    travel += (after - before).norm();
  }
  return travel;
}

std::vector<double> least_travel(const RobotOnPlane& robot, const PointLayer& points, const Trace& trace) {
  return trace.points() < 2 ? trace.joints : PosturePath(robot, points, trace).smoothest();
}

}  // namespace hbr::inline robots
