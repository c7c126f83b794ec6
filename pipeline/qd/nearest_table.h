// Exact nearest-neighbour look-ups in a finished repertoire: the box of the descriptors is cut into cells,
// and each cell names the points that are the nearest of some place in it. Few are: a cell is one 64-bit word
// that holds their indices, so that a query reads one word and a few points, takes no branch, and many
// queries fill the lanes of a vector.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "pipeline/core/check.h"
#include "pipeline/qd/elites.h"

namespace hbr::inline qd {

template <int D>
class NearestTable {
 public:
  // points [n x D], n > 0; the box [low, high]^D is cut into about 8 to 8 * 2^D cells a point.
  NearestTable(const Rows& points, float low, float high)
      : size_(points.rows()), low_(low), cells_(cells_for(size_)), per_cell_(cells_ / (high - low)) {
    HBR_CHECK(size_ > 0 && points.cols() == D, "{} x {} points", points.rows(), points.cols());
    points_.assign(points.data(), points.data() + points.size());
    std::size_t total = 1;
    for (int d = 0; d < D; ++d) total *= static_cast<std::size_t>(cells_);
    cell_.resize(total + 1);  // the last one is all that is outside
    std::vector<std::uint32_t> all(static_cast<std::size_t>(size_));
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::uint32_t>(i);
    Box root;
    root.corner.fill(0);
    root.side = cells_;
    split(root, all);
    cell_[total] = spilled(all);
  }

  // Index of the nearest point, the lower one of two as near. A query outside the box is exact too, but slow.
  std::int32_t nearest(const float* query) const {
    std::array<const float*, D> queries;
    for (int d = 0; d < D; ++d) queries[d] = query + d;
    std::int32_t found;
    short_indices() ? nearest_of<16, 1>(1, queries, &found) : nearest_of<32, 1>(1, queries, &found);
    return found;
  }

  // The same for n queries; query[d][i] is coordinate d of query i. Queries do not wait for each other's
  // memory.
  void nearest(int n, const std::array<const float*, D>& query, std::int32_t* found) const {
    short_indices() ? nearest_of<16, 64>(n, query, found) : nearest_of<32, 64>(n, query, found);
  }

  const float* point(std::int32_t i) const { return &points_[static_cast<std::size_t>(i) * D]; }
  Eigen::Index size() const { return size_; }

 private:
  struct Box {
    std::array<int, D> corner;  // in cells
    int side;                   // in cells
  };

  // Candidates in ascending order, each Bits wide, the first one lowest and the last one repeated to fill up.
  // Or, where they are more than fit, kSpilled<Bits> lowest and above it which run of spilled_ they are.
  using Cell = std::uint64_t;
  template <int Bits>
  static constexpr Cell kSpilled = (Cell{1} << Bits) - 1;

  // As many along a dimension, a power of two, as make 8 cells a point, but no more than 2^22 in all: 32 MB.
  static int cells_for(Eigen::Index points) {
    const auto total = [](int cells) {
      double product = 1;
      for (int d = 0; d < D; ++d) product *= cells;
      return product;
    };
    int cells = 1;
    while (total(cells) < 8 * static_cast<double>(points) && total(2 * cells) <= (1 << 22)) cells *= 2;
    return cells;
  }

  bool short_indices() const { return size_ < static_cast<Eigen::Index>(kSpilled<16>); }

  // Chunk queries at once, in loops without branches that compilers turn into vectors.
  template <int Bits, int Chunk>
  void nearest_of(int n, const std::array<const float*, D>& query, std::int32_t* found) const {
    const auto last = static_cast<std::uint32_t>(size_ - 1);
    for (int begin = 0; begin < n; begin += Chunk) {
      const int count = std::min(Chunk, n - begin);
      Cell cell[Chunk];
      for (int i = 0; i < count; ++i)
        cell[i] = cell_[static_cast<std::size_t>(cell_of([&](int d) { return query[d][begin + i]; }))];
      float least[Chunk];
      std::int32_t nearest[Chunk];
      bool any_spilled = false;
      for (int i = 0; i < count; ++i) {
        any_spilled |= (cell[i] & kSpilled<Bits>) == kSpilled<Bits>;
        least[i] = std::numeric_limits<float>::infinity();
        nearest[i] = -1;
      }
      for (int k = 0; k < 64 / Bits; ++k)
        for (int i = 0; i < count; ++i) {
          // Of a spilled cell any point does, its answer follows below.
          const auto index =
              std::min(static_cast<std::uint32_t>(cell[i] >> (k * Bits) & kSpilled<Bits>), last);
          float squared = 0;
          for (int d = 0; d < D; ++d) {
            const float difference = points_[index * D + d] - query[d][begin + i];
            squared += difference * difference;
          }
          const bool nearer = squared < least[i];
          least[i] = nearer ? squared : least[i];
          nearest[i] = nearer ? static_cast<std::int32_t>(index) : nearest[i];
        }
      if (any_spilled)
        for (int i = 0; i < count; ++i)
          if ((cell[i] & kSpilled<Bits>) == kSpilled<Bits>) {
            float at[D];
            for (int d = 0; d < D; ++d) at[d] = query[d][begin + i];
            nearest[i] = nearest_spilled(cell[i] >> Bits, at);
          }
      std::copy_n(nearest, count, found + begin);
    }
  }

  template <class Query>
  std::int32_t cell_of(Query&& query) const {
    const auto cells = static_cast<float>(cells_);
    std::int32_t cell = 0;
    bool inside = true;
    for (int d = 0; d < D; ++d) {
      const float c = (query(d) - low_) * per_cell_;
      const bool within = (c >= 0) & (c < cells);
      inside = inside & within;
      cell = cell * cells_ + static_cast<std::int32_t>(within ? c : 0.0f);
    }
    return inside ? cell : static_cast<std::int32_t>(cell_.size() - 1);
  }

  std::int32_t nearest_spilled(std::size_t run, const float* query) const {
    float least = std::numeric_limits<float>::infinity();
    std::int32_t found = -1;
    for (std::size_t k = runs_[run]; k < runs_[run + 1]; ++k) {
      const float* p = point(static_cast<std::int32_t>(spilled_[k]));
      float squared = 0;
      for (int d = 0; d < D; ++d) squared += (p[d] - query[d]) * (p[d] - query[d]);
      if (squared >= least) continue;
      least = squared;
      found = static_cast<std::int32_t>(spilled_[k]);
    }
    return found;
  }

  Cell spilled(const std::vector<std::uint32_t>& candidates) {
    const Cell run = runs_.size() - 1;
    spilled_.insert(spilled_.end(), candidates.begin(), candidates.end());
    runs_.push_back(spilled_.size());
    return short_indices() ? run << 16 | kSpilled<16> : run << 32 | kSpilled<32>;
  }

  Cell cell_with(const std::vector<std::uint32_t>& candidates) {
    const int bits = short_indices() ? 16 : 32;
    const std::size_t room = 64 / static_cast<std::size_t>(bits);
    if (candidates.size() > room) return spilled(candidates);
    Cell cell = 0;
    for (std::size_t k = 0; k < room; ++k)
      cell |= Cell{candidates[std::min(k, candidates.size() - 1)]} << (k * static_cast<std::size_t>(bits));
    return cell;
  }

  // Squared distances from a point to the corners of a box, which is a hair wider than its cells: a query's
  // own rounding may put it into the cell beside.
  using Corners = std::array<double, 1 << D>;
  Corners to_corners(std::uint32_t i, const Box& box) const {
    Corners corners{};
    for (int d = 0; d < D; ++d) {
      const double x = points_[static_cast<std::size_t>(i) * D + d];
      const double low = low_ + (box.corner[d] - kHair) / static_cast<double>(per_cell_) - x;
      const double high = low_ + (box.corner[d] + box.side + kHair) / static_cast<double>(per_cell_) - x;
      for (int corner = 0; corner < 1 << D; ++corner)
        corners[corner] += corner >> d & 1 ? high * high : low * low;
    }
    return corners;
  }

  // Is one point nearer than another at all corners, and so everywhere in the box (the difference of squared
  // distances has no curvature), by more than a query's rounding?
  static bool beats(const Corners& one, const Corners& other) {
    const double rounding = 4e-6 * *std::max_element(other.begin(), other.end());
    for (std::size_t c = 0; c < one.size(); ++c)
      if (one[c] + rounding >= other[c]) return false;
    return true;
  }

  // Keeps the points that no other one beats, then goes on with the halves. Of many points, where a
  // comparison of all pairs would take long, the one nearest to the box's middle stands for the others.
  void split(const Box& box, const std::vector<std::uint32_t>& from) {
    std::vector<Corners> corners(from.size());
    std::vector<double> middle(from.size(), 0.0);
    for (std::size_t i = 0; i < from.size(); ++i) {
      corners[i] = to_corners(from[i], box);
      for (const double squared : corners[i]) middle[i] += squared;
    }
    const auto central =
        static_cast<std::size_t>(std::min_element(middle.begin(), middle.end()) - middle.begin());
    constexpr std::size_t kFew = 32;
    std::vector<std::uint32_t> kept;
    std::vector<Corners> kept_corners;
    for (std::size_t i = 0; i < from.size(); ++i)
      if (!beats(corners[central], corners[i])) {
        kept.push_back(from[i]);
        kept_corners.push_back(corners[i]);
      }
    if (kept.size() <= kFew) {
      std::vector<std::uint32_t> unbeaten;
      for (std::size_t i = 0; i < kept.size(); ++i)
        if (std::none_of(kept_corners.begin(), kept_corners.end(),
                         [&](const Corners& other) { return beats(other, kept_corners[i]); }))
          unbeaten.push_back(kept[i]);
      kept = std::move(unbeaten);
    }
    if (box.side == 1) {
      std::size_t index = 0;
      for (int d = 0; d < D; ++d)
        index = index * static_cast<std::size_t>(cells_) + static_cast<std::size_t>(box.corner[d]);
      cell_[index] = cell_with(kept);
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

  static constexpr double kHair = 1e-3;  // of a cell's side

  Eigen::Index size_;
  float low_;
  int cells_;  // along each dimension
  float per_cell_;
  std::vector<float> points_;
  std::vector<Cell> cell_;
  std::vector<std::uint32_t> spilled_;
  std::vector<std::size_t> runs_ = {0};  // where each run of spilled_ begins, and where the last one ends
};

}  // namespace hbr::inline qd
