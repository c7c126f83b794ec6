#include "pipeline/hierarchy/executions.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hbr::inline hierarchy {

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
  if (open_loop()) commanded_.resize(n);
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
  if (open_loop())
    for (std::size_t i = 0; i < group.size(); ++i)
      commanded_[group[i]] = Eigen::Vector2f::Map(points_->descriptor(elites[i]));
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
  if (open_loop())
    for (std::size_t i = 0; i < n; ++i) {
      const std::int32_t by = which[i / repeat] * displacements.stride;
      Eigen::Vector2f& commanded = commanded_[group[i]];
      commanded += Eigen::Vector2f(displacements.x[by], displacements.y[by]);
      x[i] = commanded.x();
      y[i] = commanded.y();
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

// Points at most `spacing` [m] apart along each segment, its start excluded and its end included, are looked
// up all at once; then each way goes on by the elites nearest to its own, repeats left out.
void Executions::keep_way(Group group, const Displacements& displacements, const std::int32_t* which,
                          int repeat) {
  for (auto& coordinate : query_) coordinate.clear();
  ends_.clear();
  for (std::size_t i = 0; i < group.size(); ++i) {
    const Eigen::Vector2d& displacement = displacements.metres[which[i / repeat] * displacements.stride];
    const Eigen::Vector2d start = open_loop() ? points_->frame().point(commanded_[group[i]].cast<double>())
                                              : points_->position(at_[group[i]]);
    const int steps = std::max(1, static_cast<int>(std::ceil(displacement.norm() / kept_.spacing)));
    for (int step = 1; step <= steps; ++step) {
      const Eigen::Vector2d place = start + displacement * (static_cast<double>(step) / steps);
      const Eigen::Vector2f descriptor = points_->frame().point_descriptor(place).cast<float>();
      for (int d = 0; d < 2; ++d) query_[d].push_back(descriptor[d]);
    }
    ends_.push_back(query_[0].size());
  }
  passed_.resize(query_[0].size());
  points_->nearest(static_cast<int>(passed_.size()), {query_[0].data(), query_[1].data()}, passed_.data());
  for (std::size_t i = 0, next = 0; i < group.size(); ++i) {
    std::int32_t here = at_[group[i]];
    for (; next < ends_[i]; ++next)
      if (passed_[next] != here) way_[group[i]].push_back(here = passed_[next]);
  }
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
  if (open_loop())
    commanded_[execution] = points_->frame().point_descriptor(place + origin_[execution]).cast<float>();
  if (!kept_.kept) return;
  pen_down_[execution].push_back({static_cast<std::int32_t>(way_[execution].size()), width});
  way_[execution].push_back(elite);
}

}  // namespace hbr::inline hierarchy
