// The inner loops of gradients, which sum over pixels and images.
#pragma once

#include "models/autoencoder/kernels.h"

namespace hbr::net {

// to[i] += sum of all lanes of sums[i], for i < n.
template <int Count>
HBR_INLINE void add_lane_sums(const Lanes (&sums)[Count], float* to) {
  for (int i = 0; i < Count; i += kLanes) {
    Lanes group[kLanes];
#pragma GCC unroll 16
    for (int k = 0; k < kLanes; ++k) group[k] = i + k < Count ? sums[i + k] : Lanes{};
    const Lanes total = lane_sums(group);
    for (int k = 0; k < std::min(kLanes, Count - i); ++k) to[i + k] += total[k];
  }
}

// gradient[k][o] += sum over pixels and images of in * slope, for a convolution of a Size x Size map.
// in [Size][Size][In], slope [Size][Size][Out]; gradient {rows, columns, In, Out}.
template <int Taps, int In, int Out, int Size, int N>
void kernel_gradient(const Lanes* in, Index in_plane, const Lanes* slope, Index slope_plane,
                     float* gradient) {
  constexpr int half = Taps / 2, B = kConvolutionBlock<Out>;
  for (int ky = 0; ky < Taps; ++ky)
    for (int kx = 0; kx < Taps; ++kx) {
      const int dy = ky - half, dx = kx - half;
      const int x0 = std::max(0, -dx), x1 = std::min(Size, Size - dx);
      for (int o = 0; o < Out; o += B)
        for (int i = 0; i < In; i += 2) {
          Lanes sum[2 * B] = {};
          for (int v = 0; v < N; ++v)
            for (int y = std::max(0, -dy); y < std::min(Size, Size - dy); ++y) {
              const Lanes* a = in + v * in_plane + ((y + dy) * Size + x0 + dx) * In + i;
              const Lanes* s = slope + v * slope_plane + (y * Size + x0) * Out + o;
              for (int x = x0; x < x1; ++x, a += In, s += Out) {
                const Lanes a0 = a[0], a1 = a[1];
#pragma GCC unroll 8
                for (int b = 0; b < B; ++b) {
                  const Lanes g = s[b];
                  sum[b] += g * a0;
                  sum[B + b] += g * a1;
                }
              }
            }
          float total[2 * B] = {};
          add_lane_sums(sum, total);
          for (int j = 0; j < 2; ++j)
            for (int b = 0; b < B; ++b)
              gradient[((ky * Taps + kx) * In + i + j) * Out + o + b] += total[j * B + b];
        }
    }
}

// gradient[o % Channels] += sum over pixels and images of slope[pixel][o].
template <int Channels, int N>
void bias_gradient(const Lanes* slope, Index plane, Index pixels, float* gradient) {
  Lanes sum[Channels] = {};
  for (int v = 0; v < N; ++v)
    for (Index p = 0; p < pixels; ++p)
      for (int c = 0; c < Channels; ++c) sum[c] += slope[v * plane + p * Channels + c];
  add_lane_sums(sum, gradient);
}

// Gradients by outer products, where there are enough outputs to fill the lanes: there the lanes are outputs,
// and the images, now one per row, are summed over. `rows` [pixel][image][outputs] holds the slopes.

// Turns slopes [pixel][output] of one plane into rows that are `stride` apart, from `outputs` on zero.
inline void images_to_rows(const Lanes* slope, Index outputs, float* rows, Index stride) {
  for (Index o = 0; o < stride; o += kLanes) {
    Lanes block[kLanes];
    for (int k = 0; k < kLanes; ++k) block[k] = o + k < outputs ? slope[o + k] : Lanes{};
    transpose(block);
    for (int l = 0; l < kLanes; ++l) store(rows + l * stride + o, block[l]);
  }
}

// sum[i][o] += in[i] * slope[o], summed over the images of a plane, for I inputs and O * kLanes outputs.
template <int I, int O>
HBR_INLINE void outer_product(Lanes (&sum)[I][O], const Lanes* in, const float* rows, Index stride) {
  for (int l = 0; l < kLanes; ++l) {
    Lanes s[O];
#pragma GCC unroll 4
    for (int o = 0; o < O; ++o) s[o] = load(rows + l * stride + o * kLanes);
#pragma GCC unroll 8
    for (int i = 0; i < I; ++i) {
      const Lanes x = broadcast(in[i][l]);
#pragma GCC unroll 4
      for (int o = 0; o < O; ++o) sum[i][o] += x * s[o];
    }
  }
}

// real and imaginary += in * conj(slope), of complex numbers in two halves.
template <int I, int O>
HBR_INLINE void conjugate_outer_product(Lanes (&real)[I][O], Lanes (&imaginary)[I][O], const Lanes* in_real,
                                        const Lanes* in_imaginary, const float* real_rows,
                                        const float* imaginary_rows, Index stride) {
  for (int l = 0; l < kLanes; ++l) {
    Lanes c[O], d[O];
#pragma GCC unroll 4
    for (int o = 0; o < O; ++o) {
      c[o] = load(real_rows + l * stride + o * kLanes);
      d[o] = load(imaginary_rows + l * stride + o * kLanes);
    }
#pragma GCC unroll 8
    for (int i = 0; i < I; ++i) {
      const Lanes a = broadcast(in_real[i][l]), b = broadcast(in_imaginary[i][l]);
#pragma GCC unroll 4
      for (int o = 0; o < O; ++o) {
        real[i][o] += a * c[o];
        imaginary[i][o] += b * c[o];
        real[i][o] += b * d[o];
        imaginary[i][o] -= a * d[o];
      }
    }
  }
}

// Keeps a block of a gradient in registers while add(sum) adds to it.
template <int I, int O, class Add>
HBR_INLINE void update_block(float* gradient, Index stride, Add&& add) {
  Lanes sum[I][O];
#pragma GCC unroll 8
  for (int i = 0; i < I; ++i)
#pragma GCC unroll 4
    for (int o = 0; o < O; ++o) sum[i][o] = load(gradient + i * stride + o * kLanes);
  add(sum);
#pragma GCC unroll 8
  for (int i = 0; i < I; ++i)
#pragma GCC unroll 4
    for (int o = 0; o < O; ++o) store(gradient + i * stride + o * kLanes, sum[i][o]);
}

}  // namespace hbr::net
