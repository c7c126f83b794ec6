#include "models/robot/plane/board_rules.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "pipeline/core/check.h"

namespace hbr::inline robots {
namespace {

constexpr double kSteep = 20 * std::numbers::pi / 180,
                 kFlat = 70 * std::numbers::pi / 180;  // elevations, rad
constexpr double kLevel = 0.95, kLeaning = 0.9;        // of an upright board's worth

double lowest(const Board& board) {
  const DrawingPlane& plane = board.plane;
  return plane.origin[2] - plane.scale * board.half_side * (std::abs(plane.u[2]) + std::abs(plane.v[2]));
}

// How far a shape reaches below its middle, m; of its axes these are the parts along z.
double depth(const Visual& shape, const Eigen::RowVector3d& rises) {
  const Eigen::Vector3d& size = shape.size;
  const double along = std::abs(rises[2]), beside = std::sqrt(std::max(0., 1 - along * along));
  switch (shape.kind) {
    case Visual::Kind::box:
      return rises.cwiseAbs().dot(size.transpose()) / 2;
    case Visual::Kind::cylinder:
      return along * size[2] / 2 + beside * size[0];
    case Visual::Kind::capsule:
      return along * size[2] / 2 + size[0];
    case Visual::Kind::sphere:
      return size[0];
    default:
      return 0;
  }
}

}  // namespace

BoardKind board_kind(const DrawingPlane& plane) {
  const double elevation = std::asin(std::min(1., std::abs(plane.normal()[2])));
  return elevation <= kSteep ? BoardKind::upright : elevation < kFlat ? BoardKind::leaning : BoardKind::level;
}

std::pair<double, double> elevations_about(double elevation) {
  const double steep = std::abs(elevation);
  const auto [from, to] = steep <= kSteep ? std::pair(0., kSteep)
                          : steep < kFlat ? std::pair(kSteep, kFlat)
                                          : std::pair(kFlat, std::numbers::pi / 2);
  return elevation <= 0 ? std::pair(-to, -from) : std::pair(from, to);
}

BoardKind board_kind_named(const std::string& name) {
  static constexpr std::array<std::pair<const char*, BoardKind>, 4> kNames = {
      {{"any", BoardKind::any},
       {"level", BoardKind::level},
       {"upright", BoardKind::upright},
       {"leaning", BoardKind::leaning}}};
  for (const auto& [known, kind] : kNames)
    if (name == known) return kind;
  throw InputError("there is no kind of board '{}'; expected any, level, upright or leaning", name);
}

double floor_under(const Body& body) {
  const std::vector<Eigen::Isometry3d> poses =
      body.link_poses(body.lower().cwiseMax(0).cwiseMin(body.upper()));
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < body.model().links.size(); ++i) {
    if (std::ranges::count(body.moves(static_cast<int>(i)), true) > 0) continue;
    for (const Visual& shape : body.model().links[i].visuals) {
      const Eigen::Isometry3d place = poses[i] * shape.pose;
      lowest = std::min(lowest, (shape.kind == Visual::Kind::mesh ? poses[i] : place).translation()[2] -
                                    depth(shape, place.linear().row(2)));
    }
  }
  return std::isfinite(lowest) ? lowest : 0;
}

bool BoardRules::allows(const Board& board) const {
  return (kind_ == BoardKind::any || board_kind(board.plane) == kind_) && board.plane.normal()[2] >= -1e-9 &&
         lowest(board) >= floor_ - 1e-9;
}

Board BoardRules::raised(Board board) const {
  board.plane.origin[2] += std::max(0., floor_ - lowest(board));
  return board;
}

double BoardRules::worth(const Board& board) const {
  const BoardKind kind = board_kind(board.plane);
  const double liked = kind == BoardKind::level ? kLevel : kind == BoardKind::leaning ? kLeaning : 1;
  return board.plane.scale * liked * (clearance_.pierced(board) ? 0.5 : 1);
}

}  // namespace hbr::inline robots
