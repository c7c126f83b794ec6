#include "models/simbody/search_plane.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "models/simbody/refine_plane.h"
#include "pipeline/core/check.h"
#include "pipeline/qd/grid_archive.h"
#include "pipeline/qd/search.h"

namespace hbr {
namespace {

constexpr int kGenes = 6;        // origin, azimuth, elevation, scale
constexpr int kDirections = 24;  // cells of the azimuth, and of the elevation
constexpr int kBatch = 200;
constexpr double kSmallest = 1. / 8;  // of the greatest scale
constexpr double kApart = 20 * std::numbers::pi / 180;
constexpr double kStep = 1.01;  // of the scale
constexpr int kSteps = 10;

// 1 for a plane that stands upright, 0.9 for one that lies level: robots turn about level axes, so that many
// planes are as good as each other, and one of the size that stands upright is more of a board.
double upright(const DrawingPlane& plane) { return 0.9 + 0.1 * plane.v[2]; }

class PlaneEvaluator final : public Evaluator {
 public:
  PlaneEvaluator(const ReachMap& map, const std::vector<Eigen::Vector2d>& points, const Eigen::Vector3d& eye)
      : map_(map), points_(points), eye_(eye) {
    for (const Eigen::Vector2d& p : points) radius_ = std::max(radius_, p.norm());
    largest_ = map.box().diagonal().norm() / 2 / radius_;
  }
  int descriptor_size() const override { return 2; }
  bool deterministic() const override { return true; }

  DrawingPlane plane(const float* genes) const {
    const Eigen::Vector3d share(genes[0], genes[1], genes[2]);
    return DrawingPlane::facing(map_.box().min() + share.cwiseProduct(map_.box().sizes()),
                                (2 * genes[3] - 1) * std::numbers::pi, (genes[4] - 0.5) * std::numbers::pi,
                                largest_ * (kSmallest + (1 - kSmallest) * genes[5]));
  }

  void evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed) const override {
    for (Eigen::Index i = begin; i < end; ++i) {
      const float* genes = batch.genome.row(i).data();
      const DrawingPlane candidate = plane(genes);
      batch.valid[i] = (eye_ - candidate.origin).dot(candidate.normal()) >= -map_.cell();
      batch.descriptor.row(i) << genes[3], genes[4];
      if (batch.valid[i]) batch.fitness[i] = static_cast<float>(fitness(candidate));
    }
  }

 private:
  // All covered: the scale's share of the greatest, in (0, 1], less where it is not upright. Else minus the
  // share of the points that are missing and minus how far they are on average, in radii of the drawing.
  double fitness(const DrawingPlane& candidate) const {
    double missing = 0, away = 0;
    for (const Eigen::Vector2d& p : points_) {
      const double beyond = map_.distance(candidate.to_robot(p)) - 1.001 * map_.cell();
      if (beyond <= 0) continue;  // a cell without a sample beside one that has some
      ++missing;
      away += beyond;
    }
    if (missing == 0) return candidate.scale * upright(candidate) / largest_;
    return -(missing + away / (candidate.scale * radius_)) / static_cast<double>(points_.size());
  }

  const ReachMap& map_;
  const std::vector<Eigen::Vector2d>& points_;
  Eigen::Vector3d eye_;
  double radius_ = 0, largest_ = 0;
};

// Where the robot looks from: the first of the joints that draw.
Eigen::Vector3d shoulder(const Body& body) {
  int first = static_cast<int>(body.model().joints.size());
  for (const std::string& name : body.moving()) first = std::min(first, body.model().joint(name));
  const Eigen::VectorXd middle = (body.lower() + body.upper()) / 2;
  return body.link_poses(middle)[body.model().joints[first].child].translation();
}

}  // namespace

bool better(const FoundPlane& a, const FoundPlane& b) {
  if (a.covered != b.covered) return a.covered > b.covered;
  return a.plane.scale * upright(a.plane) > b.plane.scale * upright(b.plane);
}

std::vector<DrawingPlane> search_planes(const ReachMap& map, const std::vector<Eigen::Vector2d>& points,
                                        const Eigen::Vector3d& eye, int most,
                                        const PlaneSearchSettings& settings, Seed seed, Workers& workers) {
  const PlaneEvaluator evaluator(map, points, eye);
  GridArchive archive(kGenes, {2, kDirections, 0, 1});
  UniformSelector selector;
  const PolynomialMutation variation(kGenes, 10, 0.5f);
  Search search(archive, selector, variation, evaluator, {settings.generations, kBatch, settings.generations},
                seed);
  while (!search.done()) search.step(workers);

  const Elites elites = archive.store().in_id_order();
  std::vector<Eigen::Index> order(elites.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::greater(), [&](Eigen::Index i) { return elites.objective[i]; });
  std::vector<DrawingPlane> planes;
  for (const Eigen::Index i : order) {
    const DrawingPlane candidate = evaluator.plane(elites.solution.row(i).data());
    const auto same = [&](const DrawingPlane& other) {
      return candidate.normal().dot(other.normal()) > std::cos(kApart);
    };
    if (static_cast<int>(planes.size()) < most && std::ranges::none_of(planes, same))
      planes.push_back(candidate);
  }
  if (planes.empty())
    throw InputError("no plane faces the robot in {} generations of the search; give it more",
                     settings.generations);
  return planes;
}

FoundPlane find_plane(const Body& body, const ReachMap& map, const Reach& reach,
                      const std::vector<Eigen::Vector2d>& points, double tolerance,
                      const PlaneSearchSettings& settings, Seed seed, Workers& workers) {
  const auto measured = [&](const DrawingPlane& plane) {
    const auto distances = distances_to_reach(plane, reach, points, workers);
    const auto near = std::ranges::count_if(distances, [&](double d) { return d <= tolerance; });
    return FoundPlane{plane, static_cast<double>(near) / static_cast<double>(points.size())};
  };
  const auto refined = [&](const DrawingPlane& start) {
    const FoundPlane found = measured(start);
    return found.covered == 1 ? found : measured(refine_plane(start, reach, points, workers));
  };
  const auto scaled = [](DrawingPlane plane, double factor) {
    plane.scale *= factor;
    return plane;
  };
  FoundPlane best;
  for (const DrawingPlane& start :
       search_planes(map, points, shoulder(body), settings.refined, settings, seed, workers)) {
    FoundPlane found = refined(start);
    for (int i = 0; i < kSteps && found.covered < 1; ++i) {
      const FoundPlane smaller = refined(scaled(found.plane, 1 / kStep));
      if (!better(smaller, found)) break;
      found = smaller;
    }
    if (best.plane.scale == 0 || better(found, best)) best = found;
  }
  for (const double step : {kStep * kStep * kStep * kStep, kStep})
    for (int i = 0; i < kSteps && best.covered == 1; ++i) {
      const FoundPlane larger = refined(scaled(best.plane, step));
      if (!better(larger, best)) break;
      best = larger;
    }
  return best;
}

}  // namespace hbr
