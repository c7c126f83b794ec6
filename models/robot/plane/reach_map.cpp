#include "models/robot/plane/reach_map.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "models/robot/plane/nothing_free.h"
#include "pipeline/core/check.h"

namespace hbr::inline robots {
namespace {

constexpr int kCells = 40;  // along the longest side of the box
constexpr double kNone = 1e12;

Eigen::Vector3d least_spread(const std::vector<Eigen::Vector3d>& places) {
  const auto n = static_cast<Eigen::Index>(places.size());
  const Eigen::Map<const Eigen::Matrix3Xd> all(places[0].data(), 3, n);
  const Eigen::Matrix3Xd centred = all.colwise() - all.rowwise().mean();
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(centred * centred.transpose()).eigenvectors().col(0);
}

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

// Whether the tip moves along a curve only, whatever the joints [configurations x dof] do.
bool only_a_curve(const Body& body, int tip, const std::vector<double>& joints) {
  const auto dof = static_cast<std::size_t>(body.dof());
  for (std::size_t i = 0; i + dof <= std::min<std::size_t>(joints.size(), 100 * dof); i += dof) {
    Eigen::Matrix3Xd slopes;
    body.position(tip, &joints[i], &slopes);
    slopes *= (body.upper() - body.lower()).asDiagonal();
    const Eigen::Vector3d strengths =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(slopes * slopes.transpose()).eigenvalues();
    if (strengths[1] > 1e-9 * strengths[2]) return false;
  }
  return true;
}

}  // namespace

ReachMap::ReachMap(const Body& body, int tip, const Clearance& clearance, int samples, double margin,
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
  if (only_a_curve(body, tip, joints))
    throw InputError("{}: {} {} '{}' along a curve; expected joints that move it over a plane",
                     body.model().path.string(), fmt::join(body.moving(), ", "),
                     body.moving().size() == 1 ? "moves" : "move", body.model().links[tip].name);
  for (const Eigen::Vector3d& place : tips) box_.extend(place);
  flattest_ = least_spread(tips);
  cell_ = std::max(box_.sizes().maxCoeff() / kCells, 1e-9);
  size_ = (box_.sizes() / cell_).array().ceil().cast<int>().max(1);

  std::vector<Directions> clear(n);
  workers.for_ranges(n, 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) clear[i] = clearance.free(&joints[i * dof]);
  });
  const auto cells = static_cast<std::size_t>(size_.prod());
  std::vector<Directions> filled(cells);
  for (std::size_t i = 0; i < n; ++i) filled[index(cell_of(tips[i]))] |= clear[i];
  if (std::ranges::none_of(filled, &Directions::any)) throw nothing_free(body, clearance, tip, samples);

  distance_.resize(kDirections * cells);
  workers.for_each(kDirections, [&](std::size_t facing) {
    std::vector<double> squared(cells);
    for (std::size_t i = 0; i < cells; ++i) squared[i] = filled[i][facing] ? 0 : kNone;
    spread(squared);
    for (std::size_t i = 0; i < cells; ++i)
      distance_[facing * cells + i] = static_cast<float>(std::sqrt(squared[i]));
  });
}

// The squared distances, in cells, to those that are 0.
void ReachMap::spread(std::vector<double>& squared) const {
  const int nx = size_[0], ny = size_[1], nz = size_[2];
  const std::size_t row = nx, layer = row * ny;
  for (std::size_t i = 0; i < squared.size(); i += row) lower_envelope(&squared[i], nx, 1);
  for (int z = 0; z < nz; ++z)
    for (int x = 0; x < nx; ++x)
      lower_envelope(&squared[z * layer + x], ny, static_cast<std::ptrdiff_t>(row));
  for (std::size_t i = 0; i < layer; ++i) lower_envelope(&squared[i], nz, static_cast<std::ptrdiff_t>(layer));
}

Eigen::Vector3i ReachMap::cell_of(const Eigen::Vector3d& place) const {
  const Eigen::Vector3d c = ((place - box_.min()) / cell_).array().floor();
  return c.cwiseMax(0).cwiseMin((size_.array() - 1).cast<double>().matrix()).cast<int>();
}

double ReachMap::distance(const Eigen::Vector3d& place, int facing) const {
  const double outside = box_.exteriorDistance(place);
  return outside + cell_ * distance_[facing * static_cast<std::size_t>(size_.prod()) + index(cell_of(place))];
}

}  // namespace hbr::inline robots
