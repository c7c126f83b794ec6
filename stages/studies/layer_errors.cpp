#include "stages/studies/layer_errors.h"

#include <cmath>

namespace hbr::inline stages {
namespace {

// Command i is given to every execution i * starts, i * starts + 1, ...
void perform(const Side& side, const Rows& commands, int starts, Executions& executions) {
  const auto n = static_cast<int>(commands.rows());
  const Rows columns = commands.transpose();
  std::vector<const float*> coordinates;
  for (Eigen::Index d = 0; d < columns.rows(); ++d) coordinates.push_back(columns.row(d).data());
  std::vector<std::int32_t> elites(n);
  side.layer.nearest(n, coordinates.data(), elites.data());
  side.layer.perform(executions, executions.all(), elites.data(), starts);
}

// Calls compare(at, command, original, other, execution) for every command and start; `at` is the place among
// the results, `execution` that in both batches.
template <class Compare>
void for_starts(const Rows& commands, const Side& original, const Side& other, Way way, int starts, Seed seed,
                Workers& workers, Compare&& compare) {
  const auto elites = static_cast<std::uint32_t>(original.points.size());
  workers.for_ranges(commands.rows(), 16, [&](std::size_t begin, std::size_t end) {
    const auto n = static_cast<int>(end - begin) * starts;
    std::vector<std::int32_t> from, other_from;
    for (std::size_t i = begin; i < end; ++i) {
      Rng rng(seed.child(i));
      for (int s = 0; s < starts; ++s) {
        from.push_back(static_cast<std::int32_t>(rng.below(elites)));
        other_from.push_back(other.points.nearest(original.points.position(from.back())));
      }
    }
    const Rows asked =
        commands.middleRows(static_cast<Eigen::Index>(begin), static_cast<Eigen::Index>(end - begin));
    Executions drawn, drawn_by_other;
    drawn.begin(original.points, n, way);
    drawn.move(drawn.all(), from.data());
    perform(original, asked, starts, drawn);
    drawn_by_other.begin(other.points, n, way);
    drawn_by_other.move(drawn_by_other.all(), other_from.data());
    perform(other, asked, starts, drawn_by_other);
    for (int e = 0; e < n; ++e)
      compare(begin * static_cast<std::size_t>(starts) + static_cast<std::size_t>(e),
              static_cast<Eigen::Index>(begin) + e / starts, drawn, drawn_by_other, e);
  });
}

Eigen::Vector2d stop(const Executions& executions, int k, int execution) {
  return executions.points().position(executions.stop(k)[execution]);
}

ArcPoints arc_of(const Executions& executions, int execution) {
  ArcPoints points;
  for (int k = 0; k <= kArcSegments; ++k) points[k] = stop(executions, k, execution);
  return points;
}

}  // namespace

LineErrors line_errors(const Frame& frame, const Rows& commands, const Side& original, const Side& other,
                       int starts, Seed seed, Workers& workers) {
  const auto n = static_cast<std::size_t>(commands.rows() * starts);
  LineErrors errors{std::vector<float>(n), std::vector<float>(n), std::vector<float>(n)};
  for_starts(commands, original, other, {}, starts, seed, workers,
             [&](std::size_t at, Eigen::Index i, const Executions& drawn, const Executions& by_other, int e) {
               const Eigen::Vector2d end = stop(drawn, 1, e), other_end = stop(by_other, 1, e),
                                     v = end - stop(drawn, 0, e), other_v = other_end - stop(by_other, 0, e),
                                     promise = frame.line(commands.row(i).transpose().cast<double>());
               errors.end[at] = static_cast<float>((end - other_end).norm());
               errors.displacement[at] = static_cast<float>((v - other_v).norm());
               errors.promise[at] = static_cast<float>((other_v - promise).norm());
             });
  return errors;
}

ArcErrors arc_errors(const LayerModel& arcs, const Rows& commands, const Side& original, const Side& other,
                     int starts, Seed seed, Workers& workers) {
  const Frame& frame = arcs.frame();
  const ArcCentre centre = arc_outcome(arcs).centre();
  const auto n = static_cast<std::size_t>(commands.rows() * starts);
  ArcErrors errors;
  for (std::vector<float>* error :
       {&errors.end, &errors.centre, &errors.length, &errors.promised_centre, &errors.promised_length})
    error->resize(n);
  const double farthest = frame.half_side;
  for_starts(commands, original, other, arcs.executor()->way(), starts, seed, workers,
             [&](std::size_t at, Eigen::Index i, const Executions& drawn, const Executions& by_other, int e) {
               const ArcPoints path = arc_of(drawn, e), other_path = arc_of(by_other, e);
               const ArcShape shape = arc_shape(path, centre), other_shape = arc_shape(other_path, centre);
               const Eigen::Vector3d promise = commands.row(i).transpose().cast<double>();
               const Eigen::Vector2d other_centre = at_most(other_shape.centre, farthest);
               errors.end[at] = static_cast<float>((path.back() - other_path.back()).norm());
               errors.centre[at] =
                   static_cast<float>((at_most(shape.centre, farthest) - other_centre).norm());
               errors.length[at] = static_cast<float>(std::abs(shape.length - other_shape.length));
               errors.promised_centre[at] =
                   static_cast<float>((other_centre - frame.point(promise.head<2>())).norm());
               errors.promised_length[at] =
                   static_cast<float>(std::abs(other_shape.length - promise.z() * longest_arc(frame)));
             });
  return errors;
}

}  // namespace hbr::inline stages
