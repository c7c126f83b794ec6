// Vectors of floats, one lane per image. Their width follows the target of the compiler (16 lanes with
// AVX-512, 8 with AVX, else 4); every operation on them is plain C++ on GCC's and Clang's vector types. A
// lane never sees another one, except in `transpose` and `lane_sums`.
#pragma once

#include <cstdint>
#include <cstring>
#include <utility>

#define HBR_INLINE [[gnu::always_inline]] inline

namespace hbr::net {

#if defined(__AVX512F__)
inline constexpr int kLanes = 16;
#elif defined(__AVX__)
inline constexpr int kLanes = 8;
#else
inline constexpr int kLanes = 4;
#endif

using Lanes [[gnu::vector_size(kLanes * 4)]] = float;
using IntLanes [[gnu::vector_size(kLanes * 4)]] = std::int32_t;

// Outputs of a register block: as many as leave room for the operands.
#if defined(__AVX512F__) || defined(__aarch64__)
inline constexpr int kBlock = 8;
#else
inline constexpr int kBlock = 4;
#endif

// Subtracting zero changes no number, so that compilers leave it out; adding it would turn -0 into 0.
HBR_INLINE Lanes broadcast(float x) { return x - Lanes{}; }

HBR_INLINE Lanes load(const float* from) {
  Lanes x;
  std::memcpy(&x, from, sizeof x);
  return x;
}

HBR_INLINE void store(float* to, Lanes x) { std::memcpy(to, &x, sizeof x); }

namespace detail {

// Swaps the off-diagonal blocks of two rows, blocks being Width wide.
template <int Width, int... Lane>
HBR_INLINE void swap_blocks(Lanes& a, Lanes& b, std::integer_sequence<int, Lane...>) {
  const Lanes upper = __builtin_shufflevector(a, b, (Lane & Width ? Lane - Width + kLanes : Lane)...);
  const Lanes lower = __builtin_shufflevector(a, b, (Lane & Width ? Lane + kLanes : Lane + Width)...);
  a = upper;
  b = lower;
}

template <int Width>
HBR_INLINE void transpose_blocks(Lanes (&rows)[kLanes]) {
#pragma GCC unroll 16
  for (int i = 0; i < kLanes; ++i)
    if (!(i & Width)) swap_blocks<Width>(rows[i], rows[i + Width], std::make_integer_sequence<int, kLanes>());
  if constexpr (2 * Width < kLanes) transpose_blocks<2 * Width>(rows);
}

}  // namespace detail

// rows[i][j] becomes rows[j][i].
HBR_INLINE void transpose(Lanes (&rows)[kLanes]) { detail::transpose_blocks<1>(rows); }

// Lane i of the result is the sum of all lanes of sums[i].
HBR_INLINE Lanes lane_sums(Lanes (&sums)[kLanes]) {
  transpose(sums);
  Lanes total = sums[0];
#pragma GCC unroll 16
  for (int i = 1; i < kLanes; ++i) total += sums[i];
  return total;
}

// e^x, relative error below 2e-7, for |x| <= 87; beyond that as at the border.
HBR_INLINE Lanes exp(Lanes x) {
  x = x < -87.f ? broadcast(-87.f) : x;
  x = x > 87.f ? broadcast(87.f) : x;
  // x = k ln 2 + r; adding 1.5 * 2^23 leaves round(x / ln 2) in the lowest bits.
  const Lanes shifted = x * 1.44269504f + 12582912.f;
  const Lanes k = shifted - 12582912.f;
  Lanes r = x - k * 0.693359375f;
  r = r + k * 2.12194440e-4f;
  // Minimax polynomial of Cephes' expf.
  Lanes p = broadcast(1.9875691500e-4f);
  p = p * r + 1.3981999507e-3f;
  p = p * r + 8.3334519073e-3f;
  p = p * r + 4.1665795894e-2f;
  p = p * r + 1.6666665459e-1f;
  p = p * r + 5.0000001201e-1f;
  p = p * (r * r) + r;
  p = p + 1.f;
  IntLanes bits;
  std::memcpy(&bits, &shifted, sizeof bits);
  bits = (bits + 127) << 23;  // the upper bits of `shifted` fall off
  Lanes power;
  std::memcpy(&power, &bits, sizeof power);
  return p * power;
}

HBR_INLINE Lanes sigmoid(Lanes x) { return 1.f / (1.f + exp(-x)); }
HBR_INLINE Lanes tanh(Lanes x) { return 1.f - 2.f / (1.f + exp(x + x)); }

// Leaky rectifier; slopes follow from results.
HBR_INLINE Lanes leaky(Lanes x, float leak) { return x > 0.f ? x : x * leak; }
HBR_INLINE Lanes leaky_slope(Lanes y, float leak) { return y > 0.f ? broadcast(1.f) : broadcast(leak); }
HBR_INLINE Lanes tanh_slope(Lanes y) { return 1.f - y * y; }

}  // namespace hbr::net
