// A CVT container (CVT-MAP-Elites, Vassiliades, Chatzilygeroudis and Mouret 2018): one elite per cell of a
// centroidal Voronoi tessellation, the fittest. The number of cells does not grow with the descriptor's size.
#pragma once

#include <memory>

#include "pipeline/core/random.h"
#include "pipeline/qd/repertoire.h"

namespace hbr::inline qd {

// The centres of the cells [cells x descriptor_size]: k-means over 25 uniform samples a cell of the box
// [low, high]^d, a function of the seed alone. descriptor_size: 1 to 8.
Rows cvt_centroids(int cells, int descriptor_size, float low, float high, Seed seed);

// A descriptor belongs to the nearest of the centroids [cells x 1 to 8], the first of two as near. [low,
// high]^d is the box they fill; descriptors outside it are welcome.
std::unique_ptr<Repertoire> make_cvt_archive(int genes, const Rows& centroids, float low, float high);

}  // namespace hbr::inline qd
