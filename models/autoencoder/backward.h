// The backward pass of a tile.
#pragma once

#include "models/autoencoder/dense_gradient.h"

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

struct Slopes {
  Lanes* map(SlopeMap m) { return maps + m; }

  Lanes maps[kPlanes * kSlopePlane] = {};
  Conv1Gradient conv1;
  Lanes below[kSpectrum * kMaps];  // of one plane after the other: spectra below the sub-pixel convolution
};

// A gradient's numbers: one per parameter, then those of the sub-pixel kernels, deconv2's as spectra.
inline Index gradient_size(const Layout& layout) { return layout.size + kDeconv2Spectra + kSubpixelOutput; }

// After encode (training) and decode of the same tile: adds d(scale * sum over images of the mean squared
// error per pixel) to `gradient`, of all layers but the dense ones, for whose gradients it leaves a record.
// Of the tile it changes what is of one plane after the other.
void backward(const Network& network, Tile& tile, Slopes& slopes, float scale, DenseRecord& record,
              float* gradient);

}  // namespace hbr::net
