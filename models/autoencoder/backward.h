// The backward pass of a tile: adds the gradient of its images' error to a slot.
#pragma once

#include "models/autoencoder/forward.h"

namespace hbr::net {

// Where a plane keeps the slopes: the derivative of the error by what enters a layer's rectifier.
enum SlopeMap : Index {
  kOutputSlope = 0,                       // [28][28]
  kGrown2Slope = kOutputSlope + kPixels,  // [7][7][parity][8]
  kGrown1Slope = kGrown2Slope + 14 * 14 * kMaps,
  kSeedsSlope = kGrown1Slope + kFlat,
  kHidden4Slope = kSeedsSlope + kFlat,
  kHidden3Slope = kHidden4Slope + kHidden,
  kPositionSlope = kHidden3Slope + kHidden,
  kHidden2Slope = kPositionSlope + kMaxLatent,
  kHidden1Slope = kHidden2Slope + kHidden,
  kPool2Slope = kHidden1Slope + kHidden,
  kConv2Slope = kGrown2Slope,  // [14][14][8], before the pool; follows it in the same place
  kPool1Slope = kPool2Slope + kFlat,
  kSlopePlane = kPool1Slope + 14 * 14 * kMaps
};

template <int N>
struct Slopes {
  Lanes* map(SlopeMap m) { return maps + m; }

  Lanes maps[N * kSlopePlane] = {};
  Conv1Gradient conv1;
  // Of one plane after the other: spectra below and above the sub-pixel convolution, of activations and
  // slopes.
  Lanes below[kSpectrum * kMaps], above[kSpectrum * 4 * kMaps];
  // Slopes of a dense layer turned round, one row per image.
  float rows[kLanes * N * (kFlat + 8)] = {};
};

// After encode (training) and decode: adds d(scale * sum over images of the mean squared error per pixel) to
// `gradient`, laid out as a GradientSlot's.
template <int N>
void backward(const Network& network, const Tile<N>& tile, Slopes<N>& slopes, float scale, float* gradient);

}  // namespace hbr::net
