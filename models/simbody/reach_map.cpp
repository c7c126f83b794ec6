#include "models/simbody/reach_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipeline/core/check.h"

namespace hbr {
namespace {

constexpr int kCells = 80;  // along the longest side of the box
constexpr double kNone = 1e12;

// Squared distances along a line of n cells, `step` apart: f[i] becomes min over j of (i - j)^2 + f[j]
// (Felzenszwalb and Huttenlocher 2012, lower envelope of parabolas).
void lower_envelope(double* f, int n, std::ptrdiff_t step) {
  std::vector<double> value(n), from(n + 1);
  std::vector<int> root(n);
  for (int i = 0; i < n; ++i) value[i] = f[i * step];
  int k = 0;
  root[0] = 0;
  from[0] = -std::numeric_limits<double>::infinity();
  from[1] = std::numeric_limits<double>::infinity();
  for (int i = 1; i < n; ++i) {
    const auto meet = [&](int j) {
      return (value[i] + double(i) * i - value[j] - double(j) * j) / (2. * (i - j));
    };
    double s = meet(root[k]);
    while (s <= from[k]) s = meet(root[--k]);
    root[++k] = i;
    from[k] = s;
    from[k + 1] = std::numeric_limits<double>::infinity();
  }
  for (int i = 0, j = 0; i < n; ++i) {
    while (from[j + 1] < i) ++j;
    const double d = i - root[j];
    f[i * step] = d * d + value[root[j]];
  }
}

}  // namespace

ReachMap::ReachMap(const Body& body, int tip, const SelfCollision& collision, int samples, double margin,
                   Seed seed, Workers& workers) {
  const Eigen::Index dof = body.dof();
  const Eigen::VectorXd kept = margin * (body.upper() - body.lower());
  const Eigen::VectorXd lower = body.lower() + kept, range = body.upper() - kept - lower;
  const auto n = static_cast<std::size_t>(samples);
  std::vector<double> joints(n * dof);
  std::vector<Eigen::Vector3d> tips(n);
  workers.for_ranges(n, 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Rng rng(seed.child(i));
      for (Eigen::Index k = 0; k < dof; ++k) joints[i * dof + k] = lower[k] + range[k] * rng.uniform_double();
    }
    body.positions(tip, static_cast<Eigen::Index>(end - begin), &joints[begin * dof], &tips[begin]);
  });
  for (const Eigen::Vector3d& place : tips) box_.extend(place);
  cell_ = std::max(box_.sizes().maxCoeff() / kCells, 1e-9);
  size_ = (box_.sizes() / cell_).array().ceil().cast<int>().max(1);

  // A cell needs one configuration that is free: most are never asked.
  std::vector<double> squared(static_cast<std::size_t>(size_.prod()), kNone);
  bool any = false;
  for (std::size_t i = 0; i < n; ++i) {
    double& cell = squared[index(cell_of(tips[i]))];
    if (cell == 0 || collision.collides(&joints[i * dof])) continue;
    cell = 0;
    any = true;
  }
  if (!any)
    throw InputError("{}: each of {} configurations of {} runs the robot into itself; expected free ones",
                     body.model().path.string(), samples, fmt::join(body.moving(), ", "));

  const int nx = size_[0], ny = size_[1], nz = size_[2];
  const std::size_t row = nx, layer = row * ny;
  for (std::size_t i = 0; i < squared.size(); i += row) lower_envelope(&squared[i], nx, 1);
  for (int z = 0; z < nz; ++z)
    for (int x = 0; x < nx; ++x)
      lower_envelope(&squared[z * layer + x], ny, static_cast<std::ptrdiff_t>(row));
  for (std::size_t i = 0; i < layer; ++i) lower_envelope(&squared[i], nz, static_cast<std::ptrdiff_t>(layer));
  distance_.resize(squared.size());
  for (std::size_t i = 0; i < squared.size(); ++i) distance_[i] = static_cast<float>(std::sqrt(squared[i]));
}

Eigen::Vector3i ReachMap::cell_of(const Eigen::Vector3d& place) const {
  const Eigen::Vector3d c = ((place - box_.min()) / cell_).array().floor();
  return c.cwiseMax(0).cwiseMin((size_.array() - 1).cast<double>().matrix()).cast<int>();
}

double ReachMap::distance(const Eigen::Vector3d& place) const {
  const double outside = box_.exteriorDistance(place);
  return outside + cell_ * distance_[index(cell_of(place))];
}

}  // namespace hbr
