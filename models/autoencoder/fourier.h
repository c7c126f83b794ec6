// The sub-pixel convolution of 7 x 7 maps with 5 x 5 taps (network.h) and its gradients, by discrete Fourier
// transforms of 9 x 9: nine places a side are enough, because what wraps around falls outside the 7 x 7 that
// are wanted. Places are counted from the middle of a map or kernel, so that a transform splits into a real
// half of the even part and an imaginary half of the odd part. With x the maps below, w the taps, y the maps
// above:
//
//   y[p] = sum over t of x[p + t] w[t]       Y = X conj(W)
//   dx[q] = sum over t of dy[q - t] w[t]     dX = dY W
//   dw[t] = sum over p of dy[p] x[p + t]     dW = X conj(dY)
//
// A spectrum of real maps is 81 numbers: the mean's, then the real and the imaginary parts of 40 frequencies,
// one after the other; the other 40 are their conjugates. [number][map], the maps in the lanes' order of
// whoever asks.
#pragma once

#include "models/autoencoder/kernels.h"

namespace hbr::net {

namespace fourier {

inline constexpr int kPlaces = 9;
// Of j ninths of a turn.
inline constexpr float kCosines[kPlaces] = {1.f,   0.76604444311897803520f,  0.17364817766693034885f,
                                            -0.5f, -0.93969262078590838405f, -0.93969262078590838405f,
                                            -0.5f, 0.17364817766693034885f,  0.76604444311897803520f};
inline constexpr float kSines[kPlaces] = {0.f,
                                          0.64278760968653932632f,
                                          0.98480775301220805937f,
                                          0.86602540378443864676f,
                                          0.34202014332566873304f,
                                          -0.34202014332566873304f,
                                          -0.86602540378443864676f,
                                          -0.98480775301220805937f,
                                          -0.64278760968653932632f};

// Of real numbers at -R ... R: real and imaginary parts of the frequencies 0 ... 4.
template <int R>
HBR_INLINE void transform(const Lanes (&x)[2 * R + 1], Lanes (&re)[5], Lanes (&im)[5]) {
  Lanes even[R + 1], odd[R + 1];
  even[0] = x[R];
#pragma GCC unroll 4
  for (int j = 1; j <= R; ++j) {
    even[j] = x[R + j] + x[R - j];
    odd[j] = x[R - j] - x[R + j];
  }
#pragma GCC unroll 5
  for (int k = 0; k < 5; ++k) {
    re[k] = even[0];
    im[k] = Lanes{};
#pragma GCC unroll 4
    for (int j = 1; j <= R; ++j) {
      re[k] += even[j] * kCosines[j * k % kPlaces];
      if (k > 0) im[k] += odd[j] * kSines[j * k % kPlaces];
    }
  }
}

// The way back, nine times as large, from what two conjugate frequencies add up to: at p and -p the sum over
// k of even[k] cos(k p) minus and plus that of odd[k] sin(k p), in ninths of a turn.
template <int R>
HBR_INLINE void inverse(const Lanes (&even)[5], const Lanes (&odd)[5], Lanes (&x)[2 * R + 1]) {
#pragma GCC unroll 4
  for (int p = 0; p <= R; ++p) {
    Lanes a = even[0], b{};
#pragma GCC unroll 5
    for (int k = 1; k < 5; ++k) {
      a += even[k] * kCosines[k * p % kPlaces];
      if (p > 0) b += odd[k] * kSines[k * p % kPlaces];
    }
    x[R + p] = a - b;
    x[R - p] = a + b;
  }
}

// Where the frequency (row, column) stands in a spectrum, 0 <= column < 5: (0, 0) alone, then (1 ... 4, 0),
// then for each further column (0, 1, -1, 2, -2 ...).
constexpr int number_of(int row, int column) {
  if (column == 0) return row == 0 ? 0 : 2 * row - 1;
  const int place = row == 0 ? 0 : row > 0 ? 2 * row - 1 : -2 * row;
  return kPlaces + 2 * (kPlaces * (column - 1) + place);
}

}  // namespace fourier

inline constexpr int kSpectrum = fourier::kPlaces * fourier::kPlaces;

// The spectrum of a square of 2 R + 1 places a side, read by map(row, column), written by to(number, value).
template <int R, class Map, class To>
HBR_INLINE void to_spectrum(Map&& map, To&& to) {
  using namespace fourier;
  constexpr int side = 2 * R + 1;
  Lanes re[5][side], im[5][side];  // rows transformed
  for (int y = 0; y < side; ++y) {
    Lanes row[side], a[5], b[5];
    for (int x = 0; x < side; ++x) row[x] = map(y, x);
    transform<R>(row, a, b);
    for (int k = 0; k < 5; ++k) {
      re[k][y] = a[k];
      im[k][y] = b[k];
    }
  }
  Lanes a[5], b[5], c[5], d[5];
  transform<R>(re[0], a, b);
  to(0, a[0]);
  for (int k = 1; k < 5; ++k) {
    to(number_of(k, 0), a[k]);
    to(number_of(k, 0) + 1, b[k]);
  }
  for (int column = 1; column < 5; ++column) {
    transform<R>(re[column], a, b);
    transform<R>(im[column], c, d);
    to(number_of(0, column), a[0]);
    to(number_of(0, column) + 1, c[0]);
    for (int k = 1; k < 5; ++k) {
      to(number_of(k, column), a[k] - d[k]);
      to(number_of(k, column) + 1, b[k] + c[k]);
      to(number_of(-k, column), a[k] + d[k]);
      to(number_of(-k, column) + 1, c[k] - b[k]);
    }
  }
}

// The way back, kSpectrum times as large: number(n) is read, map(row, column, value) written.
template <int R, class Number, class Map>
HBR_INLINE void from_spectrum(Number&& number, Map&& map) {
  using namespace fourier;
  constexpr int side = 2 * R + 1;
  Lanes re[5][side], im[5][side];  // columns transformed back
  Lanes even[5], odd[5];
  even[0] = number(0);
  for (int k = 1; k < 5; ++k) {
    const Lanes a = number(number_of(k, 0)), b = number(number_of(k, 0) + 1);
    even[k] = a + a;
    odd[k] = b + b;
  }
  inverse<R>(even, odd, re[0]);
  for (int column = 1; column < 5; ++column) {
    Lanes even_im[5], odd_im[5];
    even[0] = number(number_of(0, column));
    even_im[0] = number(number_of(0, column) + 1);
    for (int k = 1; k < 5; ++k) {
      const Lanes a = number(number_of(k, column)), b = number(number_of(k, column) + 1);
      const Lanes c = number(number_of(-k, column)), d = number(number_of(-k, column) + 1);
      even[k] = a + c;
      odd[k] = b - d;
      even_im[k] = b + d;
      odd_im[k] = c - a;
    }
    inverse<R>(even, odd, re[column]);
    inverse<R>(even_im, odd_im, im[column]);
  }
  for (int y = 0; y < side; ++y) {
    Lanes row[side];
    even[0] = re[0][y];
    for (int k = 1; k < 5; ++k) {
      even[k] = re[k][y] + re[k][y];
      odd[k] = im[k][y] + im[k][y];
    }
    inverse<R>(even, odd, row);
    for (int x = 0; x < side; ++x) map(y, x, row[x]);
  }
}

// Spectra [number][Maps] of maps [7][7][Maps].
template <int Maps>
HBR_INLINE void maps_to_spectra(const Lanes* maps, Lanes* spectra) {
  for (int m = 0; m < Maps; ++m)
    to_spectrum<3>([&](int y, int x) { return maps[(y * 7 + x) * Maps + m]; },
                   [&](int n, Lanes value) { spectra[n * Maps + m] = value; });
}

// The maps of spectra [number][Maps], kSpectrum times as large: store(row, column, map, value).
template <int Maps, class Store>
HBR_INLINE void spectra_to_maps(const Lanes* spectra, Store&& store) {
  for (int m = 0; m < Maps; ++m)
    from_spectrum<3>([&](int n) { return spectra[n * Maps + m]; },
                     [&](int y, int x, Lanes value) { store(y, x, m, value); });
}

// Of the sub-pixel form {5, 5, 8 inputs, 32 outputs}: its spectra [number][input][output], and back. Both
// divide by kSpectrum, so that a way to spectra and back by the functions above needs no further factor.
inline constexpr int kDeconv2Spectra = kSpectrum * kMaps * 4 * kMaps;
void deconv2_to_spectra(const float* kernel, float* spectra);
void deconv2_from_spectra(const float* spectra, float* kernel);

// out[number][Out] = sum over In of in[number][In] times the weights' spectra, whose numbers lie `number`
// apart, those of an input `input`, those of an output `output`; of the weights' conjugates where Conjugate
// says so.
template <int In, int Out, bool Conjugate>
HBR_INLINE void multiply_spectra(const Lanes* in, const float* weights, Index number, Index input,
                                 Index output, Lanes* out) {
  constexpr int B = kConvolutionBlock<Out>;
  for (int o = 0; o < Out; o += B) {
    Lanes sum[1][B] = {};
    for (int i = 0; i < In; ++i) multiply_add(sum, 1, in + i, 0, weights + i * input + o * output, 0, output);
    for (int b = 0; b < B; ++b) out[o + b] = sum[0][b];
  }
  for (int n = 1; n < kSpectrum; n += 2)
    for (int o = 0; o < Out; o += B) {
      Lanes re[B] = {}, im[B] = {};
      for (int i = 0; i < In; ++i) {
        const Lanes a = in[n * In + i], b = in[(n + 1) * In + i];
        const float* w = weights + n * number + i * input + o * output;
#pragma GCC unroll 8
        for (int k = 0; k < B; ++k) {
          const Lanes c = broadcast(w[k * output]), d = broadcast(w[number + k * output]);
          re[k] += a * c;
          im[k] += b * c;
          if constexpr (Conjugate) {
            re[k] += b * d;
            im[k] -= a * d;
          } else {
            re[k] -= b * d;
            im[k] += a * d;
          }
        }
      }
      for (int k = 0; k < B; ++k) {
        out[n * Out + o + k] = re[k];
        out[(n + 1) * Out + o + k] = im[k];
      }
    }
}

}  // namespace hbr::net
