// The network once more, as loops over the paper's words: one image, double precision, no trick. `parameters`
// are laid out as net::Layout says.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "models/autoencoder/network.h"

namespace hbr::reference {

using net::Layer;
using Maps = std::vector<double>;  // [row][column][channel]

struct Result {
  Maps latent, decoded;
  double error = 0;
};

inline Maps convolve(const Layer& l, const double* parameters, const Maps& in, int size) {
  const int taps = static_cast<int>(l.shape[0]), half = taps / 2;
  const int channels = static_cast<int>(l.shape[2]), outputs = static_cast<int>(l.shape[3]);
  Maps out;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      for (int o = 0; o < outputs; ++o) {
        double sum = parameters[l.bias + o];
        for (int ky = 0; ky < taps; ++ky)
          for (int kx = 0; kx < taps; ++kx) {
            const int row = y + ky - half, column = x + kx - half;
            if (row < 0 || row >= size || column < 0 || column >= size) continue;
            for (int i = 0; i < channels; ++i)
              sum += parameters[l.kernel + ((ky * taps + kx) * channels + i) * outputs + o] *
                     in[static_cast<std::size_t>((row * size + column) * channels + i)];
          }
        out.push_back(sum);
      }
  return out;
}

inline Maps dense(const Layer& l, const double* parameters, const Maps& in) {
  Maps out;
  for (int o = 0; o < l.outputs; ++o) {
    double sum = parameters[l.bias + o];
    for (int i = 0; i < l.inputs; ++i)
      sum += parameters[l.kernel + i * l.stride + o] * in[static_cast<std::size_t>(i)];
    out.push_back(sum);
  }
  return out;
}

inline Maps activate(Maps maps, const net::Activations& a) {
  for (double& x : maps) x = a.tanh_hidden ? std::tanh(x) : x > 0 ? x : static_cast<double>(a.leak) * x;
  return maps;
}

inline std::size_t at(int size, int y, int x, int channel) {
  return static_cast<std::size_t>((y * size + x) * net::kMaps + channel);
}

inline Maps pool(const Maps& in, int size) {
  Maps out;
  for (int y = 0; y < size; y += 2)
    for (int x = 0; x < size; x += 2)
      for (int c = 0; c < net::kMaps; ++c)
        out.push_back(std::max({in[at(size, y, x, c)], in[at(size, y, x + 1, c)], in[at(size, y + 1, x, c)],
                                in[at(size, y + 1, x + 1, c)]}));
  return out;
}

inline Maps unpool(const Maps& in, int size) {
  Maps out;
  for (int y = 0; y < 2 * size; ++y)
    for (int x = 0; x < 2 * size; ++x)
      for (int c = 0; c < net::kMaps; ++c) out.push_back(in[at(size, y / 2, x / 2, c)]);
  return out;
}

inline Maps decode(const net::Layout& layout, const net::Activations& a, const double* p,
                   const Maps& latent) {
  const auto& l = layout.layers;
  Maps m = activate(dense(l[net::kDense3], p, latent), a);
  m = activate(dense(l[net::kDense4], p, m), a);
  m = activate(dense(l[net::kDense5], p, m), a);
  m = unpool(activate(convolve(l[net::kDeconv1], p, m, 7), a), 7);
  m = unpool(activate(convolve(l[net::kDeconv2], p, m, 14), a), 14);
  m = convolve(l[net::kOutput], p, m, 28);
  if (!a.linear_output)
    for (double& x : m) x = 1 / (1 + std::exp(-x));
  return m;
}

inline Result describe(const net::Layout& layout, const net::Activations& a, const double* p,
                       const Maps& image) {
  const auto& l = layout.layers;
  Maps m = pool(activate(convolve(l[net::kConv1], p, image, 28), a), 28);
  m = pool(activate(convolve(l[net::kConv2], p, m, 14), a), 14);
  m = activate(dense(l[net::kDense1], p, m), a);
  m = activate(dense(l[net::kDense2], p, m), a);
  m = dense(l[net::kLatent], p, m);
  for (double& x : m) x = std::tanh(x);
  Result r{m, decode(layout, a, p, m), 0};
  for (std::size_t i = 0; i < image.size(); ++i) r.error += std::pow(r.decoded[i] - image[i], 2) / 784;
  return r;
}

}  // namespace hbr::reference
