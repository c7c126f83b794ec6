#include "models/robot/plane/fill_gaps.h"

#include <optional>
#include <set>
#include <vector>

#include "models/robot/plane/project_onto_plane.h"
#include "models/robot/plane/reach.h"
#include "pipeline/hierarchy/joints.h"

namespace hbr::inline robots {
namespace {

constexpr int kNear = 4, kAnywhere = 8;  // starts
constexpr int kSamples = 20000;          // where inverse kinematics may start

class Gaps {
 public:
  Gaps(const RobotOnPlane& robot, const Frame& frame, const Rows& points, float spacing)
      : robot_(robot), frame_(frame), points_(points), spacing_(spacing) {}

  void fill(Elites& elites, Seed seed) const {
    std::vector<std::set<Eigen::Index>> tried(static_cast<std::size_t>(points_.rows()));
    while (pass(elites, [&](Eigen::Index gap, const auto& target, const auto& away) {
      return near(elites, target, away, tried[static_cast<std::size_t>(gap)]);
    })) {
    }
    const Board board{robot_.plane(), frame_.half_side};
    std::optional<Reach> reach;
    pass(elites, [&](Eigen::Index, const auto& target, const auto&) {
      if (!reach) reach.emplace(robot_.body(), robot_.tip(), robot_.clearance(), kSamples, 0, seed);
      const double enough = robot_.off_plane_tolerance() / 10;
      return Found{-1, arrive(reach->nearest(target, board, kAnywhere, enough).joints, target)};
    });
  }

 private:
  struct Found {
    Eigen::Index parent = -1;
    Eigen::VectorXf genes;  // empty: there is no way
  };

  // From the elites nearest to the gap, but for those `tried` for it before: what did not lead there then
  // does not lead there now.
  Found near(const Elites& elites, const Eigen::Vector3d& target, Eigen::VectorXf away,
             std::set<Eigen::Index>& tried) const {
    Eigen::VectorXd joints(robot_.dof());
    for (int k = 0; k < kNear; ++k) {
      Eigen::Index start = 0;
      away.minCoeff(&start);
      away[start] = 1e9f;
      if (!tried.insert(start).second) continue;
      decode_joints(robot_, elites.solution.row(start).data(), joints.data());
      if (Eigen::VectorXf genes = arrive(joints, target); genes.size() > 0) return {start, std::move(genes)};
    }
    return {};
  }

  Eigen::VectorXf arrive(const Eigen::VectorXd& start, const Eigen::Vector3d& target) const {
    Eigen::VectorXf genes = encode_joints(robot_, project_onto_plane(robot_, target, start));
    Eigen::VectorXd joints(robot_.dof());
    decode_joints(robot_, genes.data(), joints.data());
    const double distance = (robot_.body().position(robot_.tip(), joints.data()) - target).norm();
    if (distance > robot_.off_plane_tolerance() || !robot_.clear(joints.data(), frame_.half_side))
      genes.resize(0);
    return genes;
  }

  // Calls find(gap, target, distances of all elites from there) for each gap; whether any was filled.
  template <class Find>
  bool pass(Elites& elites, const Find& find) const {
    bool any = false;
    for (Eigen::Index i = 0; i < points_.rows(); ++i) {
      const Eigen::VectorXf away =
          (elites.measures.rowwise() - points_.row(i)).rowwise().squaredNorm().cwiseSqrt();
      if (away.minCoeff() <= spacing_) continue;
      const Eigen::Vector3d target =
          robot_.plane().to_robot(frame_.point(points_.row(i).transpose().cast<double>()));
      const Found found = find(i, target, away);
      if (found.genes.size() == 0) continue;
      const Eigen::Index row = elites.size();
      elites.solution.conservativeResize(row + 1, Eigen::NoChange);
      elites.measures.conservativeResize(row + 1, Eigen::NoChange);
      elites.objective.conservativeResize(row + 1);
      elites.solution.row(row) = found.genes.transpose();
      elites.parent.push_back(found.parent < 0 ? -1 : elites.id[static_cast<std::size_t>(found.parent)]);
      elites.id.push_back(elites.id.back() + 1);
      perform_point(robot_, frame_, elites, row);
      any = true;
    }
    return any;
  }

  const RobotOnPlane& robot_;
  const Frame& frame_;
  const Rows& points_;
  float spacing_;
};

}  // namespace

void fill_gaps(const RobotOnPlane& robot, const Frame& frame, const Rows& points, float spacing,
               Elites& elites, Seed seed) {
  Gaps(robot, frame, points, spacing).fill(elites, seed);
}

}  // namespace hbr::inline robots
