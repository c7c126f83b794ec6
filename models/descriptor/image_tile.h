// As many images as a vector has lanes, one lane each, so that what comes out for an image does not depend on
// the images beside it.
#pragma once

#include <algorithm>
#include <memory>

#include "models/autoencoder/kernels.h"

namespace hbr::inline descriptor {

// Images that a fit takes at a time; fixed, as it decides how sums are rounded.
inline constexpr Eigen::Index kFittedTogether = 512;

struct ImageTile {
  net::Lanes pixels[net::kPixels] = {};
  int images = 0;

  // Lanes past the images hold black ones.
  void load(int count, const float* from) {
    images = count;
    for (int p = 0; p < net::kPixels; ++p)
      for (int i = 0; i < net::kLanes; ++i) pixels[p][i] = i < count ? from[i * net::kPixels + p] : 0.f;
  }
};

// body(tile, first image) over n images [n x 784].
template <class Body>
void for_image_tiles(net::Index n, const float* images, Body&& body) {
  const auto tile = std::make_unique<ImageTile>();
  for (net::Index first = 0; first < n; first += net::kLanes) {
    tile->load(static_cast<int>(std::min<net::Index>(n - first, net::kLanes)), images + first * net::kPixels);
    body(*tile, first);
  }
}

// out[r] = start[r] (0 where there is none) + sum over c of matrix[r][c] * in[c], for every lane.
inline void multiply(net::Index rows, net::Index columns, const float* matrix, const float* start,
                     const net::Lanes* in, net::Lanes* out) {
  net::for_blocks(rows, [&]<int B>(net::Index first) {
    net::Lanes sum[1][B];
    net::start(sum, start ? start + first : nullptr);
    net::multiply_add(sum, columns, in, 0, matrix + first * columns, 1, columns);
    std::copy(sum[0], sum[0] + B, out + first);
  });
}

// to [images x rows], a row of each image from its lane.
inline void store_lanes(const ImageTile& tile, net::Index rows, const net::Lanes* from, float* to) {
  for (int i = 0; i < tile.images; ++i)
    for (net::Index r = 0; r < rows; ++r) to[i * rows + r] = from[r][i];
}

}  // namespace hbr::inline descriptor
