#include "models/autoencoder/network.h"

#include <algorithm>
#include <cmath>

#include "models/autoencoder/conv1.h"
#include "models/autoencoder/fourier.h"

namespace hbr::net {
namespace {

int floor_half(int i) { return (i + 1024) / 2 - 512; }

// Calls visit(index in the kernel, index in the sub-pixel form) for every pair that belongs together: output
// pixel 2i + p sees through tap k the unpooled pixel 2i + p + k, which is the small pixel i + floor((p + k) /
// 2).
template <class Visit>
void pair_subpixel(int size, int inputs, int outputs, Visit visit) {
  const int half = size / 2, small_half = (half + 1) / 2, small = 2 * small_half + 1;
  for (int parity = 0; parity < 4; ++parity)
    for (int ky = 0; ky < size; ++ky)
      for (int kx = 0; kx < size; ++kx) {
        const int sy = floor_half(parity / 2 + ky - half) + small_half;
        const int sx = floor_half(parity % 2 + kx - half) + small_half;
        for (int i = 0; i < inputs; ++i)
          for (int o = 0; o < outputs; ++o)
            visit(((ky * size + kx) * inputs + i) * outputs + o,
                  (((sy * small + sx) * inputs + i) * 4 + parity) * outputs + o);
      }
}

// Kernel of the convolution that carries gradients back.
void turn_round(int size, int inputs, int outputs, const float* kernel, Floats& back) {
  back.resize(static_cast<std::size_t>(size) * size * inputs * outputs);
  for (int tap = 0; tap < size * size; ++tap)
    for (int i = 0; i < inputs; ++i)
      for (int o = 0; o < outputs; ++o)
        back[((size * size - 1 - tap) * outputs + o) * inputs + i] = kernel[(tap * inputs + i) * outputs + o];
}

// The small pixel i reaches the output pixels 2i - 1 ... 2i + 2 in each direction, through one or two taps.
void output_to_window(const float* kernel, Floats& window) {
  window.assign(4 * 4 * kMaps, 0.f);
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      for (int ky = std::max(0, 2 - row); ky <= std::min(2, 3 - row); ++ky)
        for (int kx = std::max(0, 2 - column); kx <= std::min(2, 3 - column); ++kx)
          for (int i = 0; i < kMaps; ++i)
            window[static_cast<std::size_t>((row * 4 + column) * kMaps + i)] +=
                kernel[(ky * 3 + kx) * kMaps + i];
}

}  // namespace

Layout::Layout(int latent) : latent_size(latent) {
  const auto size_t_of = [](Index n) { return static_cast<std::size_t>(n); };
  const auto add = [&](LayerIndex i, const char* name, std::vector<std::size_t> shape, Index inputs,
                       Index outputs, Index stride) {
    Layer& l = layers[i];
    l = {name, std::move(shape), inputs, outputs, stride, size, size + padded(inputs * stride)};
    size = l.bias + padded(outputs);
  };
  const auto convolution = [&](LayerIndex i, const char* name, int side, Index in, Index out) {
    add(i, name, {size_t_of(side), size_t_of(side), size_t_of(in), size_t_of(out)}, side * side * in, out,
        out);
  };
  const auto dense = [&](LayerIndex i, const char* name, Index in, Index out) {
    add(i, name, {size_t_of(in), size_t_of(out)}, in, out, padded(out));
  };
  convolution(kConv1, "encoder_conv1", 9, 1, kMaps);
  convolution(kConv2, "encoder_conv2", 3, kMaps, kMaps);
  dense(kDense1, "encoder_dense1", kFlat, kHidden);
  dense(kDense2, "encoder_dense2", kHidden, kHidden);
  dense(kLatent, "encoder_latent", kHidden, latent);
  dense(kDense3, "decoder_dense1", latent, kHidden);
  dense(kDense4, "decoder_dense2", kHidden, kHidden);
  dense(kDense5, "decoder_dense3", kHidden, kFlat);
  convolution(kDeconv1, "decoder_conv1", 3, kMaps, kMaps);
  convolution(kDeconv2, "decoder_conv2", 9, kMaps, kMaps);
  convolution(kOutput, "decoder_output", 3, kMaps, 1);
}

void to_subpixel(int size, int inputs, int outputs, const float* kernel, float* subpixel) {
  pair_subpixel(size, inputs, outputs, [&](int k, int s) { subpixel[s] += kernel[k]; });
}

void from_subpixel(int size, int inputs, int outputs, const float* subpixel, float* kernel) {
  pair_subpixel(size, inputs, outputs, [&](int k, int s) { kernel[k] += subpixel[s]; });
}

Network::Network(int latent_size, Activations activations_)
    : layout(latent_size), activations(activations_), parameters(static_cast<std::size_t>(layout.size), 0.f) {
  refresh();
}

void Network::initialise(Seed seed, float output_start) {
  for (int l = 0; l < kLayers; ++l) {
    const Layer& layer = layout.layers[static_cast<std::size_t>(l)];
    const bool rectified = l != kLatent && l != kOutput && !activations.tanh_hidden;
    const float leak = activations.leak;
    const double gain = rectified ? 2. / (1. + leak * leak) : 1.;
    const float limit = static_cast<float>(std::sqrt(3. * gain / static_cast<double>(layer.inputs)));
    Rng rng(seed.child(layer.name));
    for (Index i = 0; i < layer.inputs; ++i)
      for (Index o = 0; o < layer.outputs; ++o)
        parameters[static_cast<std::size_t>(layer.kernel + i * layer.stride + o)] =
            rng.uniform(-limit, limit);
    for (Index o = 0; o < layer.outputs; ++o)
      parameters[static_cast<std::size_t>(layer.bias + o)] = l == kOutput ? output_start : 0.f;
  }
  refresh();
}

void Network::refresh() {
  conv1_spread.resize(kConv1Spread);
  spread_conv1(kernel(kConv1), conv1_spread.data());
  Floats deconv2(kSubpixelDeconv2, 0.f);
  to_subpixel(9, kMaps, kMaps, kernel(kDeconv2), deconv2.data());
  deconv2_spectra.resize(kDeconv2Spectra);
  deconv2_to_spectra(deconv2.data(), deconv2_spectra.data());
  output.assign(kSubpixelOutput, 0.f);
  to_subpixel(3, kMaps, 1, kernel(kOutput), output.data());
  output_bias.assign(4, *bias(kOutput));
  turn_round(3, kMaps, kMaps, kernel(kConv2), conv2_back);
  turn_round(3, kMaps, kMaps, kernel(kDeconv1), deconv1_back);
  output_to_window(kernel(kOutput), output_back);
}

}  // namespace hbr::net
