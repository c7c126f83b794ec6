#include "pipeline/qd/local_scores.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "pipeline/qd/dimension.h"
#include "pipeline/qd/neighbour_grid.h"

namespace hbr::inline qd {
namespace {

constexpr float kEverything = std::numeric_limits<float>::infinity();

template <int D>
class LocalScoresOf final : public LocalScores {
 public:
  LocalScoresOf(int neighbours, float low, float high)
      : neighbours_(neighbours), low_(low), high_(high), grid_(low, high, high - low) {}

  void update(const EliteStore& store, const std::vector<Slot>& replaced) override {
    const auto before = static_cast<Slot>(novelty_.size()), now = store.size();
    point_.resize(static_cast<std::size_t>(now) * D);
    reach2_.resize(now, kEverything);
    stale_.assign(now, 0);
    novelty_.resize(now);
    outperformed_.resize(now);

    farthest_ = 0;
    for (Slot s = 0; s < before; ++s) farthest_ = std::max(farthest_, reach2_[s]);
    for (const Slot s : replaced) {
      if (s >= before) continue;  // new ones come next
      touch(point(s));
      grid_.erase(s);
      place(s, store);
    }
    for (Slot s = before; s < now; ++s) place(s, store);
    if (now > 2 * sized_for_) resize_grid(now);

    updated_.clear();
    for (Slot s = 0; s < now; ++s)
      if (stale_[s]) updated_.push_back(s);
    for (const Slot s : updated_) score(s, store);
  }

 private:
  using Grid = NeighbourGrid<D>;

  const float* point(Slot s) const { return &point_[static_cast<std::size_t>(s) * D]; }

  // Puts the store's elite of this slot into the grid.
  void place(Slot s, const EliteStore& store) {
    std::copy_n(store.descriptor(s), D, &point_[static_cast<std::size_t>(s) * D]);
    touch(point(s));
    grid_.insert(s, point(s));
    stale_[s] = 1;
  }

  // Marks the elites whose k nearest may change with an elite at `place`.
  void touch(const float* place) {
    if (farthest_ == kEverything) {
      std::fill(stale_.begin(), stale_.end(), std::uint8_t{1});
      return;
    }
    const float reach = std::sqrt(farthest_) * 1.0001f;  // the root may have been rounded down
    grid_.near(place, reach, [&](Slot s, float squared) {
      if (!stale_[s] && squared <= reach2_[s]) stale_[s] = 1;
      return true;
    });
  }

  void score(Slot s, const EliteStore& store) {
    std::array<typename Grid::Near, kMaxNeighbours> near;
    const int found = grid_.nearest(point(s), neighbours_, s, near.data());
    float sum = 0;
    int outperformed = 0;
    for (int i = 0; i < found; ++i) {
      sum += std::sqrt(near[i].squared);
      outperformed += store.fitness(near[i].slot) < store.fitness(s);
    }
    novelty_[s] = found ? sum / static_cast<float>(found) : 0;
    outperformed_[s] = outperformed;
    reach2_[s] = found == neighbours_ ? near[found - 1].squared : kEverything;
  }

  // Cells of the grid that hold about one elite each while there are `size` to twice as many.
  void resize_grid(Slot size) {
    sized_for_ = size;
    constexpr float dims = Grid::kGridDims;
    grid_ = Grid(low_, high_, (high_ - low_) / std::pow(static_cast<float>(size), 1 / dims));
    for (Slot s = 0; s < size; ++s) grid_.insert(s, point(s));
  }

  int neighbours_;
  float low_, high_;
  Grid grid_;
  Slot sized_for_ = 0;
  std::vector<float> point_;         // [n x D] where the grid has them
  std::vector<float> reach2_;        // [n] squared distance to the k-th nearest; everything: fewer than k
  float farthest_ = 0;               // the greatest of them
  std::vector<std::uint8_t> stale_;  // [n] 1: its scores are to be computed again
};

}  // namespace

std::unique_ptr<LocalScores> make_local_scores(int descriptor_size, int neighbours, float low, float high) {
  HBR_CHECK(neighbours >= 1 && neighbours <= kMaxNeighbours && high > low, "neighbours {}, range [{}, {}]",
            neighbours, low, high);
  return with_dimension(descriptor_size, [&](auto d) -> std::unique_ptr<LocalScores> {
    return std::make_unique<LocalScoresOf<decltype(d)::value>>(neighbours, low, high);
  });
}

}  // namespace hbr::inline qd
