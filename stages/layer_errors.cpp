#include "stages/layer_errors.h"

#include <cmath>

namespace hbr {
namespace {

// Calls execution(at, task, start of the original, start of the other) for every task and start;
// `at` is the place among the results.
template <class Execution>
void for_starts(const PointLayer& original, const PointLayer& other, std::size_t tasks, int starts, Seed seed,
                Workers& workers, Execution&& execution) {
  const auto elites = static_cast<std::uint32_t>(original.size());
  workers.for_ranges(tasks, 16, [&](std::size_t begin, std::size_t end) {
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

ArcPoints execute(const PointLayer& points, const ArcTask::Requests& requests, std::int32_t start) {
  ArcWaypoints waypoints{start};
  for (std::size_t k = 0; k < requests.size(); ++k)
    waypoints[k + 1] = line_end(points, waypoints[k], requests[k]);
  return pen_positions(points, waypoints);
}

// A line asks the same of layer 1 wherever it starts.
ArcTask::Requests requests_of(const Strokes& strokes, const Eigen::Vector3d& descriptor) {
  ArcTask::Requests requests;
  const ArcLines& lines = strokes.arcs.lines(strokes.arcs.nearest(descriptor));
  for (std::size_t k = 0; k < lines.size(); ++k) requests[k] = strokes.lines.request(lines[k]);
  return requests;
}

}  // namespace

std::vector<LineTask> line_tasks(const Frame& frame, const Rows& descriptors, const LineLayer& original,
                                 const LineLayer& other) {
  std::vector<LineTask> tasks;
  for (Eigen::Index i = 0; i < descriptors.rows(); ++i) {
    const Eigen::Vector2d promise = frame.line(descriptors.row(i).transpose().cast<double>());
    tasks.push_back({original.request(promise), other.request(promise), promise});
  }
  return tasks;
}

std::vector<ArcTask> arc_tasks(const Frame& frame, const Rows& descriptors, const Strokes& original,
                               const Strokes& other) {
  std::vector<ArcTask> tasks;
  for (Eigen::Index i = 0; i < descriptors.rows(); ++i) {
    const Eigen::Vector3d descriptor = descriptors.row(i).transpose().cast<double>();
    tasks.push_back({requests_of(original, descriptor),
                     requests_of(other, descriptor),
                     {frame.point(descriptor.head<2>()), descriptor.z() * frame.longest_arc()}});
  }
  return tasks;
}

LineErrors line_errors(const PointLayer& original, const PointLayer& other,
                       const std::vector<LineTask>& tasks, int starts, Seed seed, Workers& workers) {
  const std::size_t n = tasks.size() * static_cast<std::size_t>(starts);
  LineErrors errors{std::vector<float>(n), std::vector<float>(n), std::vector<float>(n)};
  for_starts(original, other, tasks.size(), starts, seed, workers,
             [&](std::size_t at, std::size_t i, std::int32_t from, std::int32_t other_from) {
               const LineTask& task = tasks[i];
               const Eigen::Vector2d end = original.position(line_end(original, from, task.original)),
                                     other_end = other.position(line_end(other, other_from, task.other)),
                                     v = end - original.position(from),
                                     other_v = other_end - other.position(other_from);
               errors.end[at] = static_cast<float>((end - other_end).norm());
               errors.displacement[at] = static_cast<float>((v - other_v).norm());
               errors.promise[at] = static_cast<float>((other_v - task.promise).norm());
             });
  return errors;
}

ArcErrors arc_errors(const PointLayer& original, const PointLayer& other, const std::vector<ArcTask>& tasks,
                     ArcCentre centre, int starts, Seed seed, Workers& workers) {
  const std::size_t n = tasks.size() * static_cast<std::size_t>(starts);
  ArcErrors errors;
  for (std::vector<float>* error :
       {&errors.end, &errors.centre, &errors.length, &errors.promised_centre, &errors.promised_length})
    error->resize(n);
  const double farthest = original.frame().half_side;
  for_starts(
      original, other, tasks.size(), starts, seed, workers,
      [&](std::size_t at, std::size_t i, std::int32_t from, std::int32_t other_from) {
        const ArcTask& task = tasks[i];
        const ArcPoints path = execute(original, task.original, from),
                        other_path = execute(other, task.other, other_from);
        const ArcShape shape = arc_shape(path, centre), other_shape = arc_shape(other_path, centre);
        const Eigen::Vector2d other_centre = at_most(other_shape.centre, farthest);
        errors.end[at] = static_cast<float>((path.back() - other_path.back()).norm());
        errors.centre[at] = static_cast<float>((at_most(shape.centre, farthest) - other_centre).norm());
        errors.length[at] = static_cast<float>(std::abs(shape.length - other_shape.length));
        errors.promised_centre[at] = static_cast<float>((other_centre - task.promise.centre).norm());
        errors.promised_length[at] = static_cast<float>(std::abs(other_shape.length - task.promise.length));
      });
  return errors;
}

}  // namespace hbr
