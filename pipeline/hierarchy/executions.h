// A batch of executions: where the pen of each is now, and the way that it took. All go the same step
// together, so that their look-ups in layer 1 do not wait for each other.
#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/hierarchy/point_layer.h"

namespace hbr::inline hierarchy {

// Where on an execution's way the pen was put down, and how wide it is: a gene in [0, 1].
struct PenDown {
  std::int32_t first;  // index into the way
  float width;
};

// From where each displacement counts: from the elite that the one before reached, or, an open loop, from
// where that one was to end, so that what the elites miss does not add up.
enum class WayPoints { kReached, kCommanded };

// How much of the way is kept: the stops alone, or all elites that the pen passes. A displacement is drawn
// straight to its end (spacing 0) or through the elites nearest to points `spacing` [m] apart.
struct Way {
  bool kept = false;
  double spacing = 0;
  WayPoints points = WayPoints::kReached;
};

// Displacements of the pen, and the same as layer 1's look-ups take them (Frame::point_step), coordinate by
// coordinate. Number i is at place i * stride.
struct Displacements {
  const Eigen::Vector2d* metres;
  const float *x, *y;
  int stride;
};

class Executions {
 public:
  // n executions that have not begun, over a layer 1 that has to outlive them; forgets those before.
  void begin(const PointLayer& points, int n, Way way = {});

  int size() const { return static_cast<int>(at_.size()); }
  Group all() const { return all_; }
  const PointLayer& points() const { return *points_; }
  // The layer-1 elite at which the pen is now.
  std::int32_t at(int execution) const { return at_[execution]; }

  // Moves execution group[i] to elites[i]: a stop.
  void move(Group group, const std::int32_t* elites);
  // Moves execution group[i] from where it is by displacement which[i / repeat], to the elite nearest to
  // there: a stop.
  void displace(Group group, const Displacements& displacements, const std::int32_t* which, int repeat = 1);
  // Lifts the pen and puts it down at the elite nearest to a place [m], displaced by the execution's origin.
  void put_down(int execution, const Eigen::Vector2d& place, float width);

  // What places are relative to, m; (0, 0) at first.
  const Eigen::Vector2d& origin(int execution) const { return origin_[execution]; }
  void set_origin(int execution, const Eigen::Vector2d& origin) { origin_[execution] = origin; }

  // Stop k of every execution [size]; -1 where it did not move while others did.
  int stops() const { return stops_; }
  const std::int32_t* stop(int k) const { return stop_[k].data(); }
  // Where it is kept, all elites that an execution passed, and where its pen was put down.
  const std::vector<std::int32_t>& way(int execution) const { return way_[execution]; }
  const std::vector<PenDown>& pen_down(int execution) const { return pen_down_[execution]; }
  // The elites from where the pen was put down for the k-th time until it was lifted.
  std::span<const std::int32_t> stroke(int execution, int k) const;

 private:
  std::vector<std::int32_t>& next_stop(Group group);
  bool open_loop() const { return kept_.points == WayPoints::kCommanded; }
  void keep_way(Group group, const Displacements& displacements, const std::int32_t* which, int repeat);

  const PointLayer* points_ = nullptr;
  Way kept_;
  std::vector<std::int32_t> at_, all_;
  std::vector<Eigen::Vector2d> origin_;
  // Of an open loop: where each execution was to be, in layer 1's descriptor units.
  std::vector<Eigen::Vector2f> commanded_;
  // Points to look up; where those of each execution of a group end, and the elites nearest to them.
  std::vector<float> query_[2];
  std::vector<std::size_t> ends_;
  std::vector<std::int32_t> passed_;
  int stops_ = 0;
  std::vector<std::vector<std::int32_t>> stop_;  // the first stops_ are in use
  std::vector<std::vector<std::int32_t>> way_;
  std::vector<std::vector<PenDown>> pen_down_;
};

}  // namespace hbr::inline hierarchy
