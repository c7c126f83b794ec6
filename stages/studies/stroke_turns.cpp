#include "stages/studies/stroke_turns.h"

#include <cmath>

#include "pipeline/core/check.h"

namespace hbr::inline stages {
namespace {

double angle_between(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  return std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
}

}  // namespace

StrokeTurns stroke_turns(std::span<const Eigen::Vector2d> points, int arc) {
  StrokeTurns result;
  if (points.empty()) return result;
  Eigen::Vector2d before(0, 0), low = points[0], high = points[0];
  double length = 0;
  std::size_t last = 0;  // segment that moved
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    const Eigen::Vector2d segment = points[k + 1] - points[k];
    low = low.cwiseMin(points[k + 1]);
    high = high.cwiseMax(points[k + 1]);
    if (segment.isZero(0)) continue;
    if (!before.isZero(0)) {
      result.turn.push_back(static_cast<float>(angle_between(before, segment)));
      const auto of = static_cast<std::size_t>(arc);
      result.joint.push_back(arc > 0 && k / of != last / of ? 1 : 0);
    }
    before = segment;
    last = k;
    length += segment.norm();
  }
  result.length = static_cast<float>(length);
  result.side = static_cast<float>((high - low).maxCoeff());
  return result;
}

std::vector<Eigen::Vector2d> stops_of(const Executor& executor, const float* genome, int length) {
  HBR_CHECK(executor.decoder().places() && executor.way().kept, "genomes of {} genes that place no pen",
            length);
  const Rows row = Eigen::Map<const Rows>(genome, 1, length);
  Executions executions;
  std::uint8_t possible = 0;
  executor.execute(row, nullptr, 0, 1, Seed(0), executions, &possible);
  std::vector<Eigen::Vector2d> stops;
  if (!possible) return stops;
  stops.push_back(executor.points().position(executions.stroke(0, 0).front()));
  for (int k = 0; k < executions.stops(); ++k)
    if (const std::int32_t elite = executions.stop(k)[0]; elite >= 0)
      stops.push_back(executor.points().position(elite));
  return stops;
}

}  // namespace hbr::inline stages
