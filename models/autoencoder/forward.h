// The forward pass of a tile: some vectors of images side by side.
#pragma once

#include <array>
#include <memory>

#include "models/autoencoder/conv1.h"
#include "models/autoencoder/fourier.h"

namespace hbr::net {

// Vectors of images that are worked on side by side, so that a weight once loaded serves them all. Where
// vectors are wide and registers many, one keeps the units busy, and its maps stay in the cache.
#if defined(__AVX512F__)
inline constexpr int kPlanes = 1;
#else
inline constexpr int kPlanes = 2;
#endif
inline constexpr int kTileImages = kPlanes * kLanes;

// Where a plane (a vector of images) keeps what leaves each layer, after its rectifier.
enum Map : Index {
  kImage = 0,
  kPool1 = kImage + kPixels,
  kPool2 = kPool1 + 14 * 14 * kMaps,
  kHidden1 = kPool2 + kFlat,
  kHidden2 = kHidden1 + kHidden,
  kPosition = kHidden2 + kHidden,
  kHidden3 = kPosition + kMaxLatent,
  kHidden4 = kHidden3 + kHidden,
  kSeeds = kHidden4 + kHidden,  // the 7 x 7 maps that the decoder grows from
  kGrown1 = kSeeds + kFlat,
  kGrown2 = kGrown1 + kFlat,
  kDecoded = kGrown2 + 14 * 14 * kMaps,
  kPlane = kDecoded + kPixels
};

struct Tile {
  Lanes* map(Map m) { return maps + m; }  // of plane 0; the next one's lies kPlane further
  const Lanes* map(Map m) const { return maps + m; }

  Lanes maps[kPlanes * kPlane] = {};
  // Which of four pixels won the second max-pool (row * 2 + column; the first of equals): for each pooled
  // pixel two bits per channel, the first channel's lowest.
  IntLanes winners[kPlanes * 7 * 7] = {};
  // Spectra of the maps below the sub-pixel convolution (fourier.h), and above it of one plane after the
  // other.
  Lanes below[kPlanes * kSpectrum * kMaps], above[kSpectrum * 4 * kMaps];
  LitImage lit[kTileImages];  // the images one by one
  conv1::Room room;
  int images = 0;  // lanes past them hold black images
};

// Loads up to kTileImages images of 784 pixels; they may lie anywhere. Bytes stand for [0, 1] / 255.
template <class Pixel>
void load_images(Tile& tile, int count, const Pixel* const* images);

// The layers up to the latent position, and from it to the decoded image. `training` keeps the winners of the
// max-pools for the backward pass.
void encode(const Network& network, Tile& tile, bool training);
void decode(const Network& network, Tile& tile);

// Mean squared error per pixel of the images of plane v.
Lanes reconstruction_error(const Tile& tile, int v);

}  // namespace hbr::net
