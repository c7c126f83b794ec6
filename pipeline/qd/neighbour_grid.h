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

#include "pipeline/qd/dimension.h"
#include "pipeline/qd/elite_store.h"

namespace hbr::inline qd {

inline constexpr int kMaxNeighbours = 32;  // that a novelty score may average

template <int D>
class NeighbourGrid {
 public:
  static constexpr int kGridDims = D < 4 ? D : 4;
  static constexpr float kMostCells = 1 << 24;  // 64 MB

  // Box [low, high] in every dimension, cut into cells a little larger than `cell_size`, so that a radius of
  // that size reaches into the next cell and no farther; larger ones where there would be more than
  // kMostCells.
  NeighbourGrid(float low, float high, float cell_size)
      : low_(low),
        cells_(static_cast<int>(std::clamp(std::floor((high - low) / (cell_size * 1.001f)), 1.0f,
                                           std::floor(std::pow(kMostCells, 1.0f / kGridDims)) - 2))),
        size_((high - low) / static_cast<float>(cells_)) {
    std::size_t total = 1;
    for (int d = kGridDims - 1; d >= 0; --d) {
      stride_[d] = static_cast<std::ptrdiff_t>(total);
      total *= cells_ + 2;  // a border of cells that stay empty: nobody need look where the box ends
    }
    head_.assign(total, kNoSlot);
    Cell offset, middle;
    offset.fill(-1);
    middle.fill(0);
    do around_.push_back({offset, flat(offset) - flat(middle)});
    while (next(
        offset, [](int) { return -1; }, [](int) { return 1; }));
    std::stable_sort(around_.begin(), around_.end(),
                     [](const Around& a, const Around& b) { return steps(a.offset) < steps(b.offset); });
  }

  // `slot` must be the next new one, or one that was erased.
  void insert(Slot slot, const float* point) {
    if (static_cast<std::size_t>(slot) >= node_.size()) node_.resize(slot + 1);
    Node& node = node_[slot];
    std::copy_n(point, D, node.point);
    Slot& head = head_[flat(cell_of(point))];
    node.next = head;
    head = slot;
  }

  void erase(Slot slot) {
    Slot* link = &head_[flat(cell_of(node_[slot].point))];
    while (*link != slot) link = &node_[*link].next;
    *link = node_[slot].next;
  }

  // Calls visit(slot, squared distance) for every point no farther than `radius`, cell by cell from the
  // middle where the radius is at most a cell's size. Stops early when visit returns false.
  template <class Visit>
  void near(const float* point, float radius, Visit&& visit) const {
    const Place at = place(point);
    const float radius2 = radius * radius;
    const auto visit_cell = [&](std::ptrdiff_t cell) {
      for (Slot s = head_[cell]; s != kNoSlot; s = node_[s].next)
        if (const float d2 = distance2(node_[s].point, point); d2 <= radius2 && !visit(s, d2)) return false;
      return true;
    };
    if (radius < size_) {
      const std::ptrdiff_t middle = flat(at.cell);
      for (const Around& a : around_) {
        float gap2 = 0;
        for (int d = 0; d < kGridDims; ++d) gap2 += at.gap2[d][a.offset[d] + 1];
        if (gap2 <= radius2 && !visit_cell(middle + a.step)) return;
      }
      return;
    }
    // One more cell than the radius spans would be wrong only by rounding; a hair of slack settles it.
    const int reach =
        static_cast<int>(std::ceil(std::min(radius / size_ * 1.0001f, static_cast<float>(cells_))));
    const auto first = [&](int d) { return std::max(0, at.cell[d] - reach); };
    const auto last = [&](int d) { return std::min(cells_ - 1, at.cell[d] + reach); };
    Cell cell;
    for (int d = 0; d < kGridDims; ++d) cell[d] = first(d);
    do
      if (!visit_cell(flat(cell))) return;
    while (next(cell, first, last));
  }

  struct Near {
    float squared;  // distance
    Slot slot;
  };

  // The k nearest points other than `excluded`, nearest first, the lower slot first of two as near; fewer
  // when there are fewer. Returns how many.
  int nearest(const float* point, int k, Slot excluded, Near* near) const {
    const auto before = [](const Near& a, const Near& b) {
      return a.squared < b.squared || (a.squared == b.squared && a.slot < b.slot);
    };
    int found = 0;
    const Place at = place(point);
    for (int ring = 0; ring <= cells_; ++ring) {
      for_ring(at, ring, [&](const Cell& cell) {
        if (found == k && gap2(at, cell) > near[k - 1].squared) return;
        for (Slot s = head_[flat(cell)]; s != kNoSlot; s = node_[s].next) {
          if (s == excluded) continue;
          const Near candidate{distance2(node_[s].point, point), s};
          if (found == k && !before(candidate, near[k - 1])) continue;
          int i = found < k ? found++ : k - 1;
          for (; i > 0 && before(candidate, near[i - 1]); --i) near[i] = near[i - 1];
          near[i] = candidate;
        }
      });
      // Whatever lies outside this ring is at least this far (in clamped position, so in truth too).
      const float beyond = margin(at, ring);
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
  using Cell = std::array<int, kGridDims>;
  static constexpr float kSlack = 0.9999f;  // for rounding at the cells' borders

  // A point beside its link: a visit reads one place of memory.
  struct Node {
    float point[D];
    Slot next;
  };
  // A cell beside the middle one.
  struct Around {
    Cell offset;
    std::ptrdiff_t step;
  };
  // A query: its cell, its clamped position, and the squared gap between that and the cells before, at and
  // after its own.
  struct Place {
    Cell cell;
    std::array<float, kGridDims> x;
    std::array<std::array<float, 3>, kGridDims> gap2;
  };

  static int steps(const Cell& offset) {
    int sum = 0;
    for (const int o : offset) sum += std::abs(o);
    return sum;
  }

  int coordinate(float x) const { return nearest_cell((x - low_) / size_, cells_); }
  Cell cell_of(const float* point) const {
    Cell c;
    for (int d = 0; d < kGridDims; ++d) c[d] = coordinate(point[d]);
    return c;
  }
  std::ptrdiff_t flat(const Cell& c) const {
    std::ptrdiff_t index = 0;
    for (int d = 0; d < kGridDims; ++d) index += (c[d] + 1) * stride_[d];
    return index;
  }
  float lower(int cell) const { return low_ + size_ * static_cast<float>(cell); }

  Place place(const float* point) const {
    Place at;
    at.cell = cell_of(point);
    for (int d = 0; d < kGridDims; ++d) {
      at.x[d] = std::clamp(point[d], low_, lower(cells_));
      const float below = kSlack * std::max(0.0f, at.x[d] - lower(at.cell[d]));
      const float above = kSlack * std::max(0.0f, lower(at.cell[d] + 1) - at.x[d]);
      at.gap2[d] = {below * below, 0, above * above};
    }
    return at;
  }

  // Squared distance from the clamped point to a cell, a hair less.
  float gap2(const Place& at, const Cell& cell) const {
    float sum = 0;
    for (int d = 0; d < kGridDims; ++d) {
      const float gap = kSlack * std::max({0.0f, lower(cell[d]) - at.x[d], at.x[d] - lower(cell[d] + 1)});
      sum += gap * gap;
    }
    return sum;
  }

  // Least distance from the clamped point to anything outside the block of `ring` cells around its own.
  float margin(const Place& at, int ring) const {
    float least = std::numeric_limits<float>::infinity();
    for (int d = 0; d < kGridDims; ++d) {
      if (at.cell[d] - ring > 0) least = std::min(least, at.x[d] - lower(at.cell[d] - ring));
      if (at.cell[d] + ring < cells_ - 1) least = std::min(least, lower(at.cell[d] + ring + 1) - at.x[d]);
    }
    return std::max(0.0f, least * kSlack);
  }

  // The next cell of the box [first(d), last(d)], the last dimension fastest; false after the last one.
  template <class First, class Last>
  static bool next(Cell& cell, const First& first, const Last& last) {
    int d = kGridDims - 1;
    for (; d >= 0 && ++cell[d] > last(d); --d) cell[d] = first(d);
    return d >= 0;
  }

  // The cells that lie `ring` cells from the middle one in some dimension and no more in any.
  template <class Visit>
  void for_ring(const Place& at, int ring, Visit&& visit) const {
    constexpr int kLast = kGridDims - 1;
    const auto first = [&](int d) { return std::max(0, at.cell[d] - ring); };
    const auto last = [&](int d) { return std::min(cells_ - 1, at.cell[d] + ring); };
    Cell cell;
    for (int d = 0; d < kGridDims; ++d) cell[d] = first(d);
    do {
      bool on_shell = false;
      for (int d = 0; d < kLast; ++d) on_shell |= std::abs(cell[d] - at.cell[d]) == ring;
      if (on_shell || std::abs(cell[kLast] - at.cell[kLast]) == ring)
        visit(cell);
      else if (ring > 1)  // within the shell: on to the far end of this row
        cell[kLast] = std::max(cell[kLast], at.cell[kLast] + ring - 1);
    } while (next(cell, first, last));
  }

  float low_;
  int cells_;
  float size_;
  std::array<std::ptrdiff_t, kGridDims> stride_;
  std::vector<Around> around_;  // the nearest ones first
  std::vector<Slot> head_;
  std::vector<Node> node_;
};

}  // namespace hbr::inline qd
