// Exact nearest-neighbour look-ups in a finished repertoire: the box of the descriptors is cut into cells,
// and each cell lists the points that are the nearest of some place in it. A query reads one cell's list.
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
    std::vector<std::vector<std::int32_t>> lists(total);
    std::vector<std::int32_t> all(size_);
    for (Eigen::Index i = 0; i < size_; ++i) all[i] = static_cast<std::int32_t>(i);
    Box root;
    root.corner.fill(0);
    root.side = cells_;
    split(root, all, lists);
    begin_.push_back(0);
    for (const auto& list : lists) {
      for (const std::int32_t i : list) candidates_.push_back(candidate(i));
      begin_.push_back(static_cast<std::uint32_t>(candidates_.size()));
    }
  }

  // Index of the nearest point, the lower one of two as near. A query outside the box is exact too, but slow.
  std::int32_t nearest(const float* query) const {
    std::size_t cell = 0;
    for (int d = 0; d < D; ++d) {
      const float c = (query[d] - low_) * per_cell_;
      if (!(c >= 0 && c < static_cast<float>(cells_))) return scan(query);
      cell = cell * cells_ + static_cast<std::size_t>(c);
    }
    float least = std::numeric_limits<float>::infinity();
    std::int32_t found = -1;
    for (std::uint32_t i = begin_[cell]; i < begin_[cell + 1]; ++i)
      consider(candidates_[i], query, least, found);
    return found;
  }

  Eigen::Index size() const { return size_; }

 private:
  struct Box {
    std::array<int, D> corner;  // in cells
    int side;                   // in cells
  };

  // A point beside its index: a look-up reads one run of memory.
  struct Candidate {
    float point[D];
    std::int32_t index;
  };

  Candidate candidate(std::int32_t i) const {
    Candidate c;
    std::copy_n(&points_[static_cast<std::size_t>(i) * D], D, c.point);
    c.index = i;
    return c;
  }

  static void consider(const Candidate& c, const float* query, float& least, std::int32_t& found) {
    float d2 = 0;
    for (int d = 0; d < D; ++d) d2 += (c.point[d] - query[d]) * (c.point[d] - query[d]);
    const bool nearer = d2 < least;
    least = nearer ? d2 : least;
    found = nearer ? c.index : found;
  }

  std::int32_t scan(const float* query) const {
    float least = std::numeric_limits<float>::infinity();
    std::int32_t found = -1;
    for (std::int32_t i = 0; i < size_; ++i) consider(candidate(i), query, least, found);
    return found;
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
  void split(const Box& box, const std::vector<std::int32_t>& from,
             std::vector<std::vector<std::int32_t>>& lists) {
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
      std::size_t cell = 0;
      for (int d = 0; d < D; ++d) cell = cell * cells_ + box.corner[d];
      lists[cell] = std::move(kept);
      return;
    }
    for (int child = 0; child < (1 << D); ++child) {
      Box half = box;
      half.side /= 2;
      for (int d = 0; d < D; ++d)
        if (child >> d & 1) half.corner[d] += half.side;
      split(half, kept, lists);
    }
  }

  float low_;
  int cells_;
  float per_cell_;
  Eigen::Index size_;
  std::vector<float> points_;
  std::vector<std::uint32_t> begin_;
  std::vector<Candidate> candidates_;
};

}  // namespace hbr
