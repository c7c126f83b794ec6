// The unstructured archive of archive-curiosity (Cully and Demiris 2017, section III-B; the paper's appendix
// gives l and epsilon): elites keep a distance of (1 - epsilon) l; a candidate closer than l to one elite may
// replace it when it epsilon-dominates it in quality and novelty, or, with local competition (Lehman and
// Stanley 2011; the proximity archive of pyribs), when it is fitter.
#pragma once

#include <memory>

#include "pipeline/qd/repertoire.h"

namespace hbr::inline qd {

// What a candidate near an elite must do to replace it.
enum class Contest { kDominance, kFitness };

struct DistanceArchiveSettings {
  float spacing;   // l, in descriptor units; > 0
  float epsilon;   // in [0, 1)
  int neighbours;  // k of the novelty score; 1 to 32
  float low;       // range of the descriptor, the same in every dimension
  float high;
  Contest contest = Contest::kDominance;
};

inline constexpr int kMostDimensions = 8;  // of descriptors

// descriptor_size: 1 to kMostDimensions; InputError where it is more. Equal distances are settled in favour
// of the elite in the lower slot.
std::unique_ptr<Repertoire> make_distance_archive(int genes, int descriptor_size,
                                                  const DistanceArchiveSettings& settings);

}  // namespace hbr::inline qd
