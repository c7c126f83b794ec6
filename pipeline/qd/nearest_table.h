// Exact nearest-neighbour look-ups in a finished repertoire: the box of the descriptors is cut into cells,
// and each cell names the points that are the nearest of some place in it. A cell of few candidates holds
// their indices itself, so that a query reads one short run of memory and takes no branch.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "pipeline/core/check.h"
#include "pipeline/qd/elites.h"

namespace hbr {

template <int D>
class NearestTable {
 public:
  // points [n x D], n > 0; the box [low, high]^D is cut 2^levels times along every dimension.
  NearestTable(const Rows& points, float low, float high, int levels)
      : low_(low),
        cells_(1 << levels),
        per_cell_(static_cast<float>(cells_) / (high - low)),
        size_(points.rows()) {
    HBR_CHECK(size_ > 0 && points.cols() == D, "{} x {} points", points.rows(), points.cols());
    points_.assign(points.data(), points.data() + points.size());
    std::size_t total = 1;
    for (int d = 0; d < D; ++d) total *= cells_;
    cell_.resize(total + 1);  // the last one is all that is outside
    std::vector<std::int32_t> all(size_);
    for (Eigen::Index i = 0; i < size_; ++i) all[i] = static_cast<std::int32_t>(i);
    Box root;
    root.corner.fill(0);
    root.side = cells_;
    split(root, all);
    cell_[total] = spilled(all);
  }

  // Index of the nearest point, the lower one of two as near. A query outside the box is exact too, but slow.
  std::int32_t nearest(const float* query) const {
    return nearest_in(cell_[cell_of([&](int d) { return query[d]; })], query);
  }

  // The same for n queries; query[d][i] is coordinate d of query i. Queries do not wait for each other's
  // memory.
  void nearest(int n, const std::array<const float*, D>& query, std::int32_t* found) const {
    constexpr int kChunk = 64;
    std::array<std::uint32_t, kChunk> cells;
    for (int begin = 0; begin < n; begin += kChunk) {
      const int count = std::min(kChunk, n - begin);
      for (int i = 0; i < count; ++i) cells[i] = cell_of([&](int d) { return query[d][begin + i]; });
      for (int i = 0; i < count; ++i) {
        float at[D];
        for (int d = 0; d < D; ++d) at[d] = query[d][begin + i];
        found[begin + i] = nearest_in(cell_[cells[i]], at);
      }
    }
  }

  const float* point(std::int32_t i) const { return &points_[static_cast<std::size_t>(i) * D]; }
  Eigen::Index size() const { return size_; }

 private:
  struct Box {
    std::array<int, D> corner;  // in cells
    int side;                   // in cells
  };

  // The candidates in ascending order, the last one repeated to fill up; or, where they are more, -1 - begin
  // and end of a run of spilled_.
  static constexpr int kInline = 6;
  using Cell = std::array<std::int32_t, kInline>;

  template <class Query>
  std::uint32_t cell_of(Query&& query) const {
    std::uint32_t cell = 0;
    bool inside = true;
    for (int d = 0; d < D; ++d) {
      const float c = (query(d) - low_) * per_cell_;
      inside &= c >= 0 && c < static_cast<float>(cells_);
      cell = cell * cells_ + static_cast<std::uint32_t>(static_cast<std::int32_t>(inside ? c : 0.0f));
    }
    return inside ? cell : static_cast<std::uint32_t>(cell_.size() - 1);
  }

  std::int32_t nearest_in(const Cell& cell, const float* query) const {
    float least = std::numeric_limits<float>::infinity();
    std::int32_t found = -1;
    if (cell[0] >= 0) [[likely]] {
      for (const std::int32_t i : cell) consider(i, query, least, found);
    } else {
      for (std::int32_t k = -1 - cell[0]; k < -1 - cell[1]; ++k) consider(spilled_[k], query, least, found);
    }
    return found;
  }

  void consider(std::int32_t i, const float* query, float& least, std::int32_t& found) const {
    const float* p = point(i);
    float d2 = 0;
    for (int d = 0; d < D; ++d) d2 += (p[d] - query[d]) * (p[d] - query[d]);
    const bool nearer = d2 < least;
    least = nearer ? d2 : least;
    found = nearer ? i : found;
  }

  Cell spilled(const std::vector<std::int32_t>& candidates) {
    Cell cell{};
    cell[0] = -1 - static_cast<std::int32_t>(spilled_.size());
    spilled_.insert(spilled_.end(), candidates.begin(), candidates.end());
    cell[1] = -1 - static_cast<std::int32_t>(spilled_.size());
    return cell;
  }

  // Least and greatest squared distance from a point to a box.
  void reach(std::int32_t i, const Box& box, double& near2, double& far2) const {
    near2 = far2 = 0;
    for (int d = 0; d < D; ++d) {
      const double low = low_ + box.corner[d] / static_cast<double>(per_cell_);
      const double high = low + box.side / static_cast<double>(per_cell_);
      const double x = points_[static_cast<std::size_t>(i) * D + d];
      const double near = std::max({low - x, x - high, 0.0}), far = std::max(x - low, high - x);
      near2 += near * near;
      far2 += far * far;
    }
  }

  // Keeps the points that are no farther from the box than some other point's farthest corner of it (a hair
  // more, for the query's rounding), then goes on with the halves.
  void split(const Box& box, const std::vector<std::int32_t>& from) {
    std::vector<double> near2(from.size());
    double bound = std::numeric_limits<double>::infinity(), far2 = 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
      reach(from[i], box, near2[i], far2);
      bound = std::min(bound, far2);
    }
    std::vector<std::int32_t> kept;
    for (std::size_t i = 0; i < from.size(); ++i)
      if (near2[i] <= bound * 1.0001 + 1e-12) kept.push_back(from[i]);
    if (box.side == 1) {
      std::size_t index = 0;
      for (int d = 0; d < D; ++d) index = index * cells_ + box.corner[d];
      Cell& cell = cell_[index];
      if (kept.size() > kInline) {
        cell = spilled(kept);
      } else {
        cell.fill(kept.back());
        std::copy(kept.begin(), kept.end(), cell.begin());
      }
      return;
    }
    for (int child = 0; child < (1 << D); ++child) {
      Box half = box;
      half.side /= 2;
      for (int d = 0; d < D; ++d)
        if (child >> d & 1) half.corner[d] += half.side;
      split(half, kept);
    }
  }

  float low_;
  int cells_;
  float per_cell_;
  Eigen::Index size_;
  std::vector<float> points_;
  std::vector<Cell> cell_;
  std::vector<std::int32_t> spilled_;
};

}  // namespace hbr
