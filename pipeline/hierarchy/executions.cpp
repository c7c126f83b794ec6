#include "pipeline/hierarchy/executions.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hbr {
namespace {

// Appends the elites nearest to points at most `spacing` [m] apart along the segment, the start excluded, the
// end included, repeats left out.
void pass_along(const PointLayer& points, std::int32_t start, const Eigen::Vector2d& displacement,
                double spacing, std::vector<std::int32_t>& way) {
  const Eigen::Vector2d origin = points.position(start);
  const int steps = std::max(1, static_cast<int>(std::ceil(displacement.norm() / spacing)));
  std::int32_t here = start;
  for (int i = 1; i <= steps; ++i) {
    const std::int32_t next = points.nearest(origin + displacement * (static_cast<double>(i) / steps));
    if (next != here) way.push_back(here = next);
  }
}

}  // namespace

void Executions::begin(const PointLayer& points, int n, Way way) {
  points_ = &points;
  kept_ = way;
  stops_ = 0;
  at_.assign(n, -1);
  if (static_cast<int>(all_.size()) != n) {
    all_.resize(n);
    std::iota(all_.begin(), all_.end(), 0);
    origin_.resize(n);
  }
  std::fill(origin_.begin(), origin_.end(), Eigen::Vector2d::Zero());
  if (!way.kept) return;
  way_.resize(std::max<std::size_t>(way_.size(), n));
  pen_down_.resize(way_.size());
  for (int e = 0; e < n; ++e) {
    way_[e].clear();
    pen_down_[e].clear();
  }
}

// All executions of the group are to be written; the others stay.
std::vector<std::int32_t>& Executions::next_stop(Group group) {
  if (static_cast<int>(stop_.size()) == stops_) stop_.emplace_back();
  std::vector<std::int32_t>& stop = stop_[stops_++];
  stop.resize(at_.size());
  if (group.size() < at_.size()) std::fill(stop.begin(), stop.end(), -1);
  return stop;
}

void Executions::move(Group group, const std::int32_t* elites) {
  std::vector<std::int32_t>& stop = next_stop(group);
  if (group.size() == at_.size()) {
    std::copy_n(elites, group.size(), stop.data());
    at_ = stop;
  } else {
    for (std::size_t i = 0; i < group.size(); ++i) stop[group[i]] = at_[group[i]] = elites[i];
  }
  if (kept_.kept)
    for (std::size_t i = 0; i < group.size(); ++i) way_[group[i]].push_back(elites[i]);
}

void Executions::displace(Group group, const Displacements& displacements, const std::int32_t* which,
                          int repeat) {
  if (kept_.kept && kept_.spacing > 0) keep_way(group, displacements, which, repeat);
  const std::size_t n = group.size();
  const bool all = n == at_.size();
  for (auto& coordinate : query_) coordinate.resize(n);
  float *const x = query_[0].data(), *const y = query_[1].data();
  for (std::size_t i = 0, run = 0; i < n; ++run) {
    const std::int32_t by = which[run] * displacements.stride;
    const float step_x = displacements.x[by], step_y = displacements.y[by];
    for (const std::size_t end = i + repeat; i < end; ++i) {
      const float* from = points_->descriptor(at_[all ? i : group[i]]);
      x[i] = from[0] + step_x;
      y[i] = from[1] + step_y;
    }
  }
  std::vector<std::int32_t>& stop = next_stop(group);
  if (all) {
    points_->nearest(static_cast<int>(n), {x, y}, stop.data());
    at_ = stop;
  } else {
    std::vector<std::int32_t> found(n);
    points_->nearest(static_cast<int>(n), {x, y}, found.data());
    for (std::size_t i = 0; i < n; ++i) stop[group[i]] = at_[group[i]] = found[i];
  }
  if (kept_.kept && kept_.spacing == 0)
    for (const std::int32_t execution : group) way_[execution].push_back(at_[execution]);
}

void Executions::keep_way(Group group, const Displacements& displacements, const std::int32_t* which,
                          int repeat) {
  for (std::size_t i = 0; i < group.size(); ++i)
    pass_along(*points_, at_[group[i]], displacements.metres[which[i / repeat] * displacements.stride],
               kept_.spacing, way_[group[i]]);
}

std::span<const std::int32_t> Executions::stroke(int execution, int k) const {
  const std::vector<PenDown>& down = pen_down_[execution];
  const std::vector<std::int32_t>& way = way_[execution];
  const auto first = static_cast<std::size_t>(down[k].first),
             end = k + 1 < static_cast<int>(down.size()) ? static_cast<std::size_t>(down[k + 1].first)
                                                         : way.size();
  return {way.data() + first, end - first};
}

void Executions::put_down(int execution, const Eigen::Vector2d& place, float width) {
  const std::int32_t elite = points_->nearest(place + origin_[execution]);
  at_[execution] = elite;
  if (!kept_.kept) return;
  pen_down_[execution].push_back({static_cast<std::int32_t>(way_[execution].size()), width});
  way_[execution].push_back(elite);
}

}  // namespace hbr
