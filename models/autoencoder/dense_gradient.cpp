#include "models/autoencoder/dense_gradient.h"

#include <utility>

#include "models/autoencoder/gradient_kernels.h"

namespace hbr::net {
namespace {

// Where the inputs of a dense layer begin among those of all.
Index first_input(LayerIndex which) {
  constexpr Map maps[kDenseLayers] = {kPool2, kHidden1, kHidden2, kPosition, kHidden3, kHidden4};
  return maps[which - kDense1] - kPool2;
}

Index first_slope(const Layout& layout, LayerIndex which) {
  Index strides = 0;
  for (int l = kDense1; l < which; ++l) strides += layout.layers[static_cast<std::size_t>(l)].stride;
  return kTileImages * strides;
}

// Of I inputs and O vectors of outputs.
template <int I, int O>
void add_block(std::span<const DenseRecord> tiles, Index input, Index slope, Index stride, float* gradient) {
  update_block<I, O>(gradient, stride, [&](Lanes(&sum)[I][O]) {
    for (const DenseRecord& tile : tiles)
      for (int v = 0; v < kPlanes; ++v)
        outer_product(sum, tile.inputs + v * kDenseInputs + input, tile.slopes + slope + v * kLanes * stride,
                      stride);
  });
}

}  // namespace

float* DenseRecord::rows(const Layout& layout, LayerIndex which) {
  return slopes + first_slope(layout, which);
}
const float* DenseRecord::rows(const Layout& layout, LayerIndex which) const {
  return slopes + first_slope(layout, which);
}

void add_dense_gradients(const Layout& layout, std::span<const DenseRecord> tiles, Index begin, Index end,
                         float* gradient) {
  for (int l = kDense1; l <= kDense5; ++l) {
    const auto which = static_cast<LayerIndex>(l);
    const Layer& layer = layout.layers[static_cast<std::size_t>(l)];
    const Index first = first_input(which), slope = first_slope(layout, which);
    const Index last = std::min(end - first, layer.inputs);
    const Index from = std::max<Index>(begin - first, 0);
    // Two vectors of slopes of all images stay in the cache while the inputs pass by.
    const auto add = [&]<int O>(Index o, std::integral_constant<int, O>) {
      constexpr int block = O == 4 ? kBlock / 2 : kBlock;
      Index i = from;
      for (; i + block <= last; i += block)
        add_block<block, O>(tiles, first + i, slope + o, layer.stride,
                            gradient + layer.kernel + i * layer.stride + o);
      for (; i < last; ++i)
        add_block<1, O>(tiles, first + i, slope + o, layer.stride,
                        gradient + layer.kernel + i * layer.stride + o);
    };
    Index o = 0;
    for (; o + 4 * kLanes <= layer.stride; o += 4 * kLanes) add(o, std::integral_constant<int, 4>());
    for (; o + 2 * kLanes <= layer.stride; o += 2 * kLanes) add(o, std::integral_constant<int, 2>());
    for (; o < layer.stride; o += kLanes) add(o, std::integral_constant<int, 1>());
  }
}

void add_dense_biases(const Layout& layout, std::span<const DenseRecord> tiles, float* gradient) {
  for (int l = kDense1; l <= kDense5; ++l) {
    const Layer& layer = layout.layers[static_cast<std::size_t>(l)];
    for (const DenseRecord& tile : tiles) {
      const float* rows = tile.rows(layout, static_cast<LayerIndex>(l));
      for (int image = 0; image < kTileImages; ++image)
        for (Index o = 0; o < layer.stride; ++o) gradient[layer.bias + o] += rows[image * layer.stride + o];
    }
  }
}

}  // namespace hbr::net
