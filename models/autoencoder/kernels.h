// The inner loops. Maps lie pixel by pixel, channels together ([row][column][channel][lane]), so that a row
// of taps of a convolution is one run of memory, in the map as in the kernel, and a dense layer is a single
// run. N planes (vectors of images) are worked on at once, `plane` Lanes apart, so that a weight once loaded
// serves N * kLanes images.
#pragma once

#include <algorithm>

#include "models/autoencoder/lanes.h"
#include "models/autoencoder/network.h"

namespace hbr::net {

// The units between the layers; their slope follows from their result, too.
class HiddenUnits {
 public:
  explicit HiddenUnits(const Activations& activations)
      : leak_(activations.leak), tanh_(activations.tanh_hidden) {}
  HBR_INLINE Lanes operator()(Lanes x) const { return tanh_ ? tanh(x) : leaky(x, leak_); }
  HBR_INLINE Lanes slope(Lanes y) const { return tanh_ ? tanh_slope(y) : leaky_slope(y, leak_); }

 private:
  float leak_;
  bool tanh_;
};

// body.template operator()<B>(first) over blocks of B = kBlock, 4, 2, 1 that cover [0, n).
template <class Body>
HBR_INLINE void for_blocks(Index n, Body&& body) {
  Index i = 0;
  for (; i + kBlock <= n; i += kBlock) body.template operator()<kBlock>(i);
  if constexpr (kBlock > 4)
    for (; i + 4 <= n; i += 4) body.template operator()<4>(i);
  for (; i + 2 <= n; i += 2) body.template operator()<2>(i);
  for (; i < n; ++i) body.template operator()<1>(i);
}

// sum[v][b] += sum over k < n of weight[k * step + b * across] * in[v][k].
template <int N, int B>
HBR_INLINE void multiply_add(Lanes (&sum)[N][B], Index n, const Lanes* in, Index plane, const float* weight,
                             Index step, Index across) {
  for (Index k = 0; k < n; ++k) {
    Lanes x[N];
#pragma GCC unroll 4
    for (int v = 0; v < N; ++v) x[v] = in[v * plane + k];
#pragma GCC unroll 8
    for (int b = 0; b < B; ++b) {
      const Lanes w = broadcast(weight[k * step + b * across]);
#pragma GCC unroll 4
      for (int v = 0; v < N; ++v) sum[v][b] += w * x[v];
    }
  }
}

template <int N, int B>
HBR_INLINE void start(Lanes (&sum)[N][B], const float* bias) {
#pragma GCC unroll 8
  for (int b = 0; b < B; ++b)
#pragma GCC unroll 4
    for (int v = 0; v < N; ++v) sum[v][b] = bias ? broadcast(bias[b]) : Lanes{};
}

// Convolution at one pixel for B outputs; taps outside the map are skipped. `in` is a Size x Size map of In
// channels; `weight` {rows, columns, In, Out} starts at the first of the B outputs.
template <int Taps, int In, int Out, int Size, int N, int B>
HBR_INLINE void convolve_pixel(Lanes (&sum)[N][B], const Lanes* in, Index plane, const float* weight, int y,
                               int x) {
  constexpr int half = Taps / 2;
  const int end = std::min(Taps, Size + half - y);
  const int first = std::max(0, half - x), last = std::min(Taps, Size + half - x);
  for (int ky = std::max(0, half - y); ky < end; ++ky)
    multiply_add(sum, (last - first) * In, in + ((y + ky - half) * Size + x + first - half) * In, plane,
                 weight + (ky * Taps + first) * In * Out, Out, 1);
}

template <int Out>
inline constexpr int kConvolutionBlock = std::min(kBlock, Out);

// The whole map: store(y, x, first output, sum).
template <int Taps, int In, int Out, int Size, int N, class Store>
HBR_INLINE void convolve(const Lanes* in, Index plane, const float* weight, const float* bias,
                         Store&& store) {
  for (int y = 0; y < Size; ++y)
    for (int x = 0; x < Size; ++x)
      for (int o = 0; o < Out; o += kConvolutionBlock<Out>) {
        Lanes sum[N][kConvolutionBlock<Out>];
        start(sum, bias ? bias + o : nullptr);
        convolve_pixel<Taps, In, Out, Size>(sum, in, plane, weight + o, y, x);
        store(y, x, o, sum);
      }
}

}  // namespace hbr::net
