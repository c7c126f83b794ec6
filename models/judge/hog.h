// Histograms of oriented gradients (Dalal and Triggs 2005): what the judge sees of an image.
#pragma once

#include <cstdint>

#include "pipeline/core/parallel.h"
#include "pipeline/qd/elites.h"

namespace hbr::inline judge {

// 3 x 3 overlapping blocks of 2 x 2 cells of 7 x 7 pixels, 9 directions: what OpenCV computes of 28 x 28.
inline constexpr int kHogSize = 324;

// The features [n x 324] of images [n x 28 x 28].
Rows hog_features(std::size_t n, const std::uint8_t* images, Workers& workers);

}  // namespace hbr::inline judge
