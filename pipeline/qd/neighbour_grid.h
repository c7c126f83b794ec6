// Exact neighbour search among moving points: a uniform grid of linked lists.
//
// Points outside the box live in the cells of its border. That keeps every bound below valid, because
// clamping two points to a box never moves them apart. In more than four dimensions the grid spans the first
// four: a distance within a subspace never exceeds the whole one.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "pipeline/qd/elite_store.h"

namespace hbr {

template <int D>
class NeighbourGrid {
 public:
  static constexpr int kGridDims = D < 4 ? D : 4;
  using Cell = std::array<int, kGridDims>;

  // Box [low, high] in every dimension, cut into cells of at least `cell_size`.
  NeighbourGrid(float low, float high, float cell_size)
      : low_(low),
        cells_(std::max(1, static_cast<int>(std::floor((high - low) / cell_size)))),
        size_((high - low) / static_cast<float>(cells_)) {
    std::size_t total = 1;
    for (int d = 0; d < kGridDims; ++d) total *= cells_;
    head_.assign(total, kNoSlot);
  }

  // `slot` must be the next new one, or one that was erased.
  void insert(Slot slot, const float* point) {
    if (static_cast<std::size_t>(slot) >= next_.size()) next_.resize(slot + 1, kNoSlot);
    Slot& head = head_[flat(cell_of(point))];
    next_[slot] = head;
    head = slot;
  }

  void erase(Slot slot, const float* point) {
    Slot* link = &head_[flat(cell_of(point))];
    while (*link != slot) link = &next_[*link];
    *link = next_[slot];
  }

  // Calls visit(slot) for every point in the cells around `point` that could be within `radius` of it.
  // Stops early when visit returns false.
  template <class Visit>
  void near(const float* point, float radius, Visit&& visit) const {
    const Cell centre = cell_of(point);
    // One more cell than the radius spans would be wrong only by rounding; a hair of slack settles it.
    const int reach = static_cast<int>(std::ceil(radius / size_ * 1.0001f));
    for_block(centre, reach, [&](Slot s) { return visit(s); });
  }

  struct Near {
    float squared;  // distance
    Slot slot;
  };

  // The k nearest points other than `excluded`, nearest first, the lower slot first of two as near; fewer
  // when there are fewer. Returns how many. point_of(slot) gives the position with which a slot was inserted.
  template <class PointOf>
  int nearest(PointOf&& point_of, const float* point, int k, Slot excluded, Near* near) const {
    const auto before = [](const Near& a, const Near& b) {
      return a.squared < b.squared || (a.squared == b.squared && a.slot < b.slot);
    };
    int found = 0;
    const Cell centre = cell_of(point);
    for (int ring = 0; ring <= cells_; ++ring) {
      for_ring(centre, ring, [&](Slot s) {
        if (s == excluded) return;
        const Near candidate{distance2(point_of(s), point), s};
        if (found == k && !before(candidate, near[k - 1])) return;
        int at = found < k ? found++ : k - 1;
        for (; at > 0 && before(candidate, near[at - 1]); --at) near[at] = near[at - 1];
        near[at] = candidate;
      });
      // Whatever lies outside this ring is at least this far (in clamped position, so in truth too).
      const float beyond = margin(point, centre, ring);
      if (found == k && near[k - 1].squared < beyond * beyond) break;
    }
    return found;
  }

  static float distance2(const float* a, const float* b) {
    float sum = 0;
    for (int d = 0; d < D; ++d) sum += (a[d] - b[d]) * (a[d] - b[d]);
    return sum;
  }

 private:
  int coordinate(float x) const {
    const float c = (x - low_) / size_;
    return c <= 0 ? 0 : std::min(cells_ - 1, static_cast<int>(c));
  }
  Cell cell_of(const float* point) const {
    Cell c;
    for (int d = 0; d < kGridDims; ++d) c[d] = coordinate(point[d]);
    return c;
  }
  std::size_t flat(const Cell& c) const {
    std::size_t index = 0;
    for (int d = 0; d < kGridDims; ++d) index = index * cells_ + c[d];
    return index;
  }

  // Least distance from the (clamped) point to anything outside the block of `ring` cells around its own.
  float margin(const float* point, const Cell& centre, int ring) const {
    float least = std::numeric_limits<float>::infinity();
    for (int d = 0; d < kGridDims; ++d) {
      const float x = std::clamp(point[d], low_, low_ + size_ * static_cast<float>(cells_));
      if (centre[d] - ring > 0)
        least = std::min(least, x - (low_ + size_ * static_cast<float>(centre[d] - ring)));
      if (centre[d] + ring < cells_ - 1)
        least = std::min(least, low_ + size_ * static_cast<float>(centre[d] + ring + 1) - x);
    }
    return std::max(0.0f, least * 0.9999f);  // slack for rounding at the cells' borders
  }

  template <class Visit>
  bool visit_cell(std::size_t index, Visit& visit) const {
    for (Slot s = head_[index]; s != kNoSlot; s = next_[s])
      if (!visit(s)) return false;
    return true;
  }

  template <class Visit>
  void for_block(const Cell& centre, int reach, Visit&& visit) const {
    Cell low, high, at;
    for (int d = 0; d < kGridDims; ++d) {
      low[d] = std::max(0, centre[d] - reach);
      high[d] = std::min(cells_ - 1, centre[d] + reach);
    }
    at = low;
    while (true) {
      const std::size_t row = flat(at) - low[kGridDims - 1];
      for (int x = low[kGridDims - 1]; x <= high[kGridDims - 1]; ++x)
        if (!visit_cell(row + x, visit)) return;
      int d = kGridDims - 2;
      for (; d >= 0 && ++at[d] > high[d]; --d) at[d] = low[d];
      if (d < 0) return;
    }
  }

  template <class Visit>
  void for_ring(const Cell& centre, int ring, Visit&& visit) const {
    Cell low, high, at;
    for (int d = 0; d < kGridDims; ++d) {
      low[d] = std::max(0, centre[d] - ring);
      high[d] = std::min(cells_ - 1, centre[d] + ring);
    }
    at = low;
    auto keep_going = [&](Slot s) { return visit(s), true; };
    constexpr int kLast = kGridDims - 1;
    while (true) {
      bool on_shell = false;
      for (int d = 0; d < kLast; ++d) on_shell |= std::abs(at[d] - centre[d]) == ring;
      const std::size_t row = flat(at) - low[kLast];
      if (on_shell || ring == 0) {
        for (int x = low[kLast]; x <= high[kLast]; ++x) visit_cell(row + x, keep_going);
      } else {  // only the two ends of this row lie on the shell
        if (centre[kLast] - ring >= 0) visit_cell(row + centre[kLast] - ring, keep_going);
        if (centre[kLast] + ring < cells_) visit_cell(row + centre[kLast] + ring, keep_going);
      }
      int d = kGridDims - 2;
      for (; d >= 0 && ++at[d] > high[d]; --d) at[d] = low[d];
      if (d < 0) return;
    }
  }

  float low_;
  int cells_;
  float size_;
  std::vector<Slot> head_, next_;
};

}  // namespace hbr
