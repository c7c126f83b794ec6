#include "stages/studies/line_accuracy.h"

#include <cmath>
#include <numbers>

#include "pipeline/hierarchy/executions.h"
#include "pipeline/hierarchy/layers/lines.h"
#include "pipeline/qd/neighbour_grid.h"

namespace hbr::inline stages {
namespace {

using Grid = NeighbourGrid<4>;

std::vector<float> squared_errors(const LineRequests& requests, const Executions& executions) {
  const PointLayer& points = executions.points();
  std::vector<float> errors;
  for (std::size_t i = 0; i < requests.wanted.size(); ++i) {
    const Eigen::Vector2d drawn =
        points.position(executions.stop(1)[i]) - points.position(executions.stop(0)[i]);
    errors.push_back(static_cast<float>((requests.wanted[i] - drawn).squaredNorm()));
  }
  return errors;
}

Executions started(const LineRequests& requests, const PointLayer& points) {
  Executions executions;
  executions.begin(points, static_cast<int>(requests.start.size()));
  executions.move(executions.all(), requests.start.data());
  return executions;
}

}  // namespace

LineRequests draw_line_requests(int n, const PointLayer& points, double longest_line, Rng rng) {
  LineRequests requests;
  for (int i = 0; i < n; ++i) {
    const double direction = 2 * std::numbers::pi * rng.uniform_double();
    const double length = longest_line * rng.uniform_double();
    requests.wanted.push_back(length * Eigen::Vector2d(std::cos(direction), std::sin(direction)));
    requests.start.push_back(static_cast<std::int32_t>(rng.below(static_cast<std::uint32_t>(points.size()))));
  }
  return requests;
}

std::vector<float> squared_line_errors(const LineRequests& requests, const PointLayer& points,
                                       const Frame& frame, const Layer& lines) {
  std::vector<float> command[2];
  for (const Eigen::Vector2d& wanted : requests.wanted) {
    const Eigen::Vector2f descriptor = frame.line_descriptor(wanted).cast<float>();
    for (int d = 0; d < 2; ++d) command[d].push_back(descriptor[d]);
  }
  const float* const commands[2] = {command[0].data(), command[1].data()};
  std::vector<std::int32_t> elites(requests.wanted.size());
  lines.nearest(static_cast<int>(elites.size()), commands, elites.data());
  Executions executions = started(requests, points);
  lines.perform(executions, executions.all(), elites.data());
  return squared_errors(requests, executions);
}

ReferenceErrors squared_reference_errors(const LineRequests& requests, const PointLayer& points,
                                         const Frame& frame, const Elites& reference, Workers& workers) {
  Grid grid(0, 1, 0.02f);
  for (Slot s = 0; s < reference.size(); ++s) grid.insert(s, reference.measures.row(s).data());
  const std::size_t n = requests.wanted.size();
  std::vector<std::int32_t> ends(n), which(n);
  std::vector<Eigen::Vector2d> displacements(n);
  std::vector<float> step[2] = {std::vector<float>(n), std::vector<float>(n)};
  workers.for_ranges(n, 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Eigen::Vector4f asked;
      asked << frame.point_descriptor(points.position(requests.start[i])).cast<float>(),
          frame.line_descriptor(requests.wanted[i]).cast<float>();
      Grid::Near near;
      grid.nearest(asked.data(), 1, kNoSlot, &near);
      const Eigen::Vector4d found = reference.measures.row(near.slot).transpose().cast<double>();
      ends[i] = points.nearest(Eigen::Vector2d(frame.point(found.head<2>()) + frame.line(found.tail<2>())));
      displacements[i] = decode_line(frame, reference.solution.row(near.slot).data());
      const Eigen::Vector2f in_units = points.frame().point_step(displacements[i]);
      for (int d = 0; d < 2; ++d) step[d][i] = in_units[d];
      which[i] = static_cast<std::int32_t>(i);
    }
  });
  Executions to_end = started(requests, points), displaced = started(requests, points);
  to_end.move(to_end.all(), ends.data());
  displaced.displace(displaced.all(), {displacements.data(), step[0].data(), step[1].data(), 1},
                     which.data());
  return {squared_errors(requests, to_end), squared_errors(requests, displaced)};
}

}  // namespace hbr::inline stages
