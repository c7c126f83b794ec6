#include "stages/layer_errors.h"

#include <cmath>

namespace hbr {
namespace {

// Calls execution(at, controller, start of the original, start of the other) for every controller and start;
// `at` is the place among the results.
template <class Execution>
void for_starts(const PointLayer& original, const PointLayer& other, std::size_t controllers, int starts,
                Seed seed, Workers& workers, Execution&& execution) {
  const auto elites = static_cast<std::uint32_t>(original.size());
  workers.for_ranges(controllers, 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Rng rng(seed.child(i));
      for (int s = 0; s < starts; ++s) {
        const auto start = static_cast<std::int32_t>(rng.below(elites));
        execution(i * static_cast<std::size_t>(starts) + static_cast<std::size_t>(s), i, start,
                  other.nearest(original.position(start)));
      }
    }
  });
}

ArcPoints execute(const PointLayer& points, const std::array<Eigen::Vector2d, kArcSegments>& requests,
                  std::int32_t start) {
  ArcWaypoints waypoints{start};
  for (std::size_t k = 0; k < requests.size(); ++k)
    waypoints[k + 1] = line_end(points, waypoints[k], requests[k]);
  return pen_positions(points, waypoints);
}

}  // namespace

LineErrors line_errors(const PointLayer& original, const PointLayer& other,
                       const std::vector<Eigen::Vector2d>& requests, int starts, Seed seed,
                       Workers& workers) {
  const std::size_t n = requests.size() * static_cast<std::size_t>(starts);
  LineErrors errors{std::vector<float>(n), std::vector<float>(n)};
  for_starts(original, other, requests.size(), starts, seed, workers,
             [&](std::size_t at, std::size_t i, std::int32_t from, std::int32_t other_from) {
               const Eigen::Vector2d end = original.position(line_end(original, from, requests[i])),
                                     other_end = other.position(line_end(other, other_from, requests[i])),
                                     v = end - original.position(from),
                                     other_v = other_end - other.position(other_from);
               errors.end[at] = static_cast<float>((end - other_end).norm());
               errors.displacement[at] = static_cast<float>((v - other_v).norm());
             });
  return errors;
}

ArcErrors arc_errors(const PointLayer& original, const PointLayer& other, const LineLayer& lines,
                     const std::vector<ArcLines>& arcs, ArcCentre centre, int starts, Seed seed,
                     Workers& workers) {
  // A line asks the same of layer 1 wherever it starts.
  std::vector<ArcLines> requests(arcs.size());
  for (std::size_t i = 0; i < arcs.size(); ++i)
    for (std::size_t k = 0; k < arcs[i].size(); ++k) requests[i][k] = lines.request(arcs[i][k]);

  const std::size_t n = arcs.size() * static_cast<std::size_t>(starts);
  ArcErrors errors{std::vector<float>(n), std::vector<float>(n), std::vector<float>(n)};
  const double farthest = original.frame().half_side;
  for_starts(original, other, arcs.size(), starts, seed, workers,
             [&](std::size_t at, std::size_t i, std::int32_t from, std::int32_t other_from) {
               const ArcPoints path = execute(original, requests[i], from),
                               other_path = execute(other, requests[i], other_from);
               const ArcShape shape = arc_shape(path, centre), other_shape = arc_shape(other_path, centre);
               errors.end[at] = static_cast<float>((path.back() - other_path.back()).norm());
               errors.centre[at] = static_cast<float>(
                   (at_most(shape.centre, farthest) - at_most(other_shape.centre, farthest)).norm());
               errors.length[at] = static_cast<float>(std::abs(shape.length - other_shape.length));
             });
  return errors;
}

}  // namespace hbr
