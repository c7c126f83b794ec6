// The gradients of the dense layers, of all tiles of a group at once: a weight's gradient is summed over the
// group's images without leaving its register. Rows of weights, one per input, are independent of each other,
// so threads may share them.
#pragma once

#include <span>

#include "models/autoencoder/forward.h"

namespace hbr::net {

inline constexpr int kDenseLayers = kDense5 - kDense1 + 1;
// Inputs of all dense layers, one after the other as in a Tile, and their outputs with their padding.
inline constexpr Index kDenseInputs = kSeeds - kPool2;
inline constexpr Index kDenseStrides = 4 * padded(kHidden) + padded(kMaxLatent) + padded(kFlat);

// What the dense layers of one tile leave for their gradients.
struct DenseRecord {
  // The slopes of the outputs of a dense layer, [image][stride].
  float* rows(const Layout& layout, LayerIndex which);
  const float* rows(const Layout& layout, LayerIndex which) const;

  Lanes inputs[kPlanes * kDenseInputs];
  float slopes[kTileImages * kDenseStrides];
};

// Adds to `gradient`, laid out as the parameters, for the inputs [begin, end) of kDenseInputs.
void add_dense_gradients(const Layout& layout, std::span<const DenseRecord> tiles, Index begin, Index end,
                         float* gradient);
// The same for the biases of all dense layers.
void add_dense_biases(const Layout& layout, std::span<const DenseRecord> tiles, float* gradient);

}  // namespace hbr::net
