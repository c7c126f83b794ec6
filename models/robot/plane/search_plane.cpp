#include "models/robot/plane/search_plane.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "models/robot/plane/refine_plane.h"
#include "pipeline/core/check.h"
#include "pipeline/qd/grid_archive.h"
#include "pipeline/qd/search.h"

namespace hbr {
namespace {

constexpr int kGenes = 6;   // origin, azimuth, elevation, scale
constexpr int kTurns = 24;  // cells of the azimuth, and of the elevation
constexpr int kBatch = 200;
constexpr double kSmallest = 1. / 8;  // of the greatest scale
constexpr double kApart = 20 * std::numbers::pi / 180;
constexpr double kLarge = 1.03, kSmall = 1.01;  // steps of the scale
constexpr int kSteps = 12;
constexpr double kLevel = 0.1;   // what a level board is worth of an upright one
constexpr double kFull = 0.995;  // share of the points that is as good as all

double radius_of(const std::vector<Eigen::Vector2d>& points) {
  double radius = 0;
  for (const Eigen::Vector2d& p : points) radius = std::max(radius, p.norm());
  return radius;
}

class PlaneEvaluator final : public Evaluator {
 public:
  PlaneEvaluator(const ReachMap& map, const Clearance& clearance, const std::vector<Eigen::Vector2d>& points,
                 double half_side, const Eigen::Vector3d& eye)
      : map_(map),
        clearance_(clearance),
        points_(points),
        half_side_(half_side),
        eye_(eye),
        radius_(radius_of(points)),
        largest_(map.box().diagonal().norm() / 2 / radius_) {}
  int descriptor_size() const override { return 2; }
  bool deterministic() const override { return true; }

  Board board(const float* genes) const {
    const Eigen::Vector3d share(genes[0], genes[1], genes[2]);
    return {DrawingPlane::facing(map_.box().min() + share.cwiseProduct(map_.box().sizes()),
                                 (2 * genes[3] - 1) * std::numbers::pi, (genes[4] - 0.5) * std::numbers::pi,
                                 largest_ * (kSmallest + (1 - kSmallest) * genes[5])),
            half_side_};
  }

  void evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed) const override {
    for (Eigen::Index i = begin; i < end; ++i) {
      const float* genes = batch.genome.row(i).data();
      const Board candidate = board(genes);
      batch.valid[i] = (eye_ - candidate.plane.origin).dot(candidate.plane.normal()) >= -map_.cell();
      batch.descriptor.row(i) << genes[3], genes[4];
      if (batch.valid[i]) batch.fitness[i] = static_cast<float>(fitness(candidate));
    }
  }

 private:
  // All covered: what it is worth, in (0, 1]. Else minus the
  // share of the points that are missing and minus how far they are on average, in radii of the drawing.
  double fitness(const Board& candidate) const {
    const int facing = nearest_direction(candidate.plane.normal());
    double missing = 0, away = 0;
    for (const Eigen::Vector2d& p : points_) {
      const double beyond = map_.distance(candidate.plane.to_robot(p), facing) - 1.001 * map_.cell();
      if (beyond <= 0) continue;  // an empty cell beside a filled one may be for want of samples
      ++missing;
      away += beyond;
    }
    if (missing <= (1 - kFull) * static_cast<double>(points_.size()))
      return plane_worth(candidate, clearance_) / largest_;
    return -(missing + away / (candidate.plane.scale * radius_)) / static_cast<double>(points_.size());
  }

  const ReachMap& map_;
  const Clearance& clearance_;
  const std::vector<Eigen::Vector2d>& points_;
  double half_side_;
  Eigen::Vector3d eye_;
  double radius_, largest_;
};

// Where the robot looks from: the first of the joints that draw.
Eigen::Vector3d shoulder(const Body& body) {
  int first = static_cast<int>(body.model().joints.size());
  for (const std::string& name : body.moving()) first = std::min(first, body.model().joint(name));
  const Eigen::VectorXd middle = (body.lower() + body.upper()) / 2;
  return body.link_poses(middle)[body.model().joints[first].child].translation();
}

}  // namespace

double plane_worth(const Board& board, const Clearance& clearance) {
  const double upright = kLevel + (1 - kLevel) * std::pow(board.plane.v[2], 4);
  return board.plane.scale * upright * (clearance.pierced(board) ? 0.5 : 1);
}

bool better(const FoundPlane& a, const FoundPlane& b) {
  if (const double full = std::min(a.covered, kFull), other = std::min(b.covered, kFull); full != other)
    return full > other;
  return a.worth > b.worth;
}

std::vector<Board> search_planes(const ReachMap& map, const Clearance& clearance,
                                 const std::vector<Eigen::Vector2d>& points, double half_side,
                                 const Eigen::Vector3d& eye, int most, const PlaneSearchSettings& settings,
                                 Seed seed, Workers& workers) {
  const PlaneEvaluator evaluator(map, clearance, points, half_side, eye);
  GridArchive archive(kGenes, {2, kTurns, 0, 1});
  UniformSelector selector;
  const PolynomialMutation variation(kGenes, 10, 0.5f);
  Search search(archive, selector, variation, evaluator, {settings.generations, kBatch, settings.generations},
                seed);
  while (!search.done()) search.step(workers);

  const Elites elites = archive.store().in_id_order();
  std::vector<Eigen::Index> order(elites.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::greater(), [&](Eigen::Index i) { return elites.objective[i]; });
  std::vector<Board> boards;
  for (const Eigen::Index i : order) {
    const Board candidate = evaluator.board(elites.solution.row(i).data());
    const auto same = [&](const Board& other) {
      return candidate.plane.normal().dot(other.plane.normal()) > std::cos(kApart);
    };
    if (static_cast<int>(boards.size()) < most && std::ranges::none_of(boards, same))
      boards.push_back(candidate);
  }
  if (boards.empty())
    throw InputError("no plane faces the robot in {} generations of the search; give it more",
                     settings.generations);
  return boards;
}

FoundPlane find_plane(const Body& body, const Clearance& clearance, const ReachMap& map, const Reach& reach,
                      const std::vector<Eigen::Vector2d>& points, double half_side, double tolerance,
                      const PlaneSearchSettings& settings, Seed seed, Workers& workers) {
  const auto measured = [&](const Board& board) {
    const auto distances = distances_to_reach(board, reach, points, workers);
    const auto near = std::ranges::count_if(distances, [&](double d) { return d <= tolerance; });
    return FoundPlane{board, static_cast<double>(near) / static_cast<double>(points.size()),
                      plane_worth(board, clearance)};
  };
  const auto refined = [&](const Board& start) {
    const FoundPlane found = measured(start);
    return found.covered >= kFull ? found : measured(refine_plane(start, reach, points, workers));
  };
  const auto scaled = [](Board board, double factor) {
    board.plane.scale *= factor;
    return board;
  };
  FoundPlane best;
  for (const Board& start : search_planes(map, clearance, points, half_side, shoulder(body), settings.refined,
                                          settings, seed, workers)) {
    FoundPlane smaller = refined(start), found = smaller;
    for (int i = 0; i < kSteps && found.covered < kFull; ++i) {
      smaller = refined(scaled(smaller.board, 1 / kLarge));
      if (better(smaller, found)) found = smaller;
    }
    if (best.board.plane.scale == 0 || better(found, best)) best = found;
  }
  for (const double step : {kLarge, kSmall})
    for (int i = 0; i < kSteps && best.covered >= kFull; ++i) {
      const FoundPlane larger = refined(scaled(best.board, step));
      if (!better(larger, best)) break;
      best = larger;
    }
  return best;
}

}  // namespace hbr
