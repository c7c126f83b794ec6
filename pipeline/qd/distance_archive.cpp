#include "pipeline/qd/distance_archive.h"

#include <array>
#include <cmath>
#include <limits>

#include "pipeline/core/check.h"
#include "pipeline/qd/neighbour_grid.h"

namespace hbr::inline qd {
namespace {

template <int D>
class DistanceArchive final : public Repertoire {
 public:
  DistanceArchive(int genes, const DistanceArchiveSettings& s)
      : Repertoire(genes, D), settings_(s), grid_(s.low, s.high, s.spacing) {}

  Added add(const Candidate& c) override {
    const Neighbours near = two_nearest(c.descriptor);
    if (near.first == kNoSlot) {
      const Slot slot = store_.append(c);
      grid_.insert(slot, c.descriptor);
      return {Admission::kNovel, slot};
    }
    // A lone elite is never replaced: it has no neighbours to be less novel than (as the published code has
    // it).
    if (size() == 1 || near.second_is_too_near || !wins(c, near.first))
      return {Admission::kRejected, kNoSlot};
    grid_.erase(near.first);
    store_.replace(near.first, c);
    grid_.insert(near.first, c.descriptor);
    return {Admission::kReplaced, near.first};
  }

  void restore(const Elites& elites) override {
    HBR_CHECK(size() == 0, "size {}", size());
    for (Eigen::Index i = 0; i < elites.size(); ++i) {
      const Candidate c = candidate_of(elites, i);
      grid_.insert(store_.append(c), c.descriptor);
    }
  }

 private:
  struct Neighbours {
    Slot first = kNoSlot;             // the nearest elite, if it is within l
    bool second_is_too_near = false;  // the second-nearest is within (1 - epsilon) l
  };

  Neighbours two_nearest(const float* point) const {
    const float inner = (1 - settings_.epsilon) * settings_.spacing;
    const float inner2 = inner * inner;
    float nearest2 = std::numeric_limits<float>::infinity();
    int within_inner = 0;
    Neighbours found;
    grid_.near(point, settings_.spacing, [&](Slot s, float d2) {
      within_inner += d2 < inner2;
      if (d2 < nearest2 || (d2 == nearest2 && s < found.first)) {
        nearest2 = d2;
        found.first = s;
      }
      return within_inner < 2;  // two that near decide the matter, whichever is the nearest
    });
    found.second_is_too_near = within_inner >= 2;
    return found;
  }

  // Mean distance to the k nearest elites, `excluded` left out.
  float novelty(const float* point, Slot excluded) const {
    std::array<typename Grid::Near, kMaxNeighbours> near;
    const int found = grid_.nearest(point, settings_.neighbours, excluded, near.data());
    float sum = 0;
    for (int i = 0; i < found; ++i) sum += std::sqrt(near[i].squared);
    return sum / static_cast<float>(found);
  }

  bool wins(const Candidate& c, Slot incumbent) const {
    return settings_.contest == Contest::kFitness ? c.fitness > store_.fitness(incumbent)
                                                  : dominates(c, incumbent);
  }

  // Exclusive epsilon-dominance: not much worse in either score, and better in their normalised sum.
  bool dominates(const Candidate& c, Slot incumbent) const {
    const float eps = settings_.epsilon;
    const float q = c.fitness, q0 = store_.fitness(incumbent);
    if (q < q0 - eps * std::abs(q0)) return false;  // (1 - sgn(q0) eps) q0
    if (q0 == 0 && q <= 0) return false;            // whatever the novelties: the sum below would be 0
    const float n = novelty(c.descriptor, kNoSlot), n0 = novelty(store_.descriptor(incumbent), incumbent);
    if (n < (1 - eps) * n0) return false;
    return (q - q0) * n0 > -(n - n0) * std::abs(q0);
  }

  using Grid = NeighbourGrid<D>;
  DistanceArchiveSettings settings_;
  Grid grid_;
};

template <int D>
std::unique_ptr<Repertoire> make(int genes, int size, const DistanceArchiveSettings& s) {
  if constexpr (D > kMostDimensions) {
    throw InputError(
        "descriptors of {} dimensions; this container has at most {}: take the container cvt, or describe "
        "solutions by less",
        size, kMostDimensions);
  } else {
    if (size == D) return std::make_unique<DistanceArchive<D>>(genes, s);
    return make<D + 1>(genes, size, s);
  }
}

}  // namespace

std::unique_ptr<Repertoire> make_distance_archive(int genes, int descriptor_size,
                                                  const DistanceArchiveSettings& s) {
  HBR_CHECK(s.neighbours >= 1 && s.neighbours <= kMaxNeighbours, "neighbours {}", s.neighbours);
  HBR_CHECK(s.spacing > 0 && s.high > s.low, "spacing {}, range [{}, {}]", s.spacing, s.low, s.high);
  return make<1>(genes, descriptor_size, s);
}

}  // namespace hbr::inline qd
