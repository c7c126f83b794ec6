#include "models/autoencoder/fourier.h"

namespace hbr::net {
namespace {

constexpr int kWeights = kMaps * 4 * kMaps;  // of one tap, or of one number of a spectrum

Lanes scaled(Lanes x) { return x * (1.f / kSpectrum); }

}  // namespace

void deconv2_to_spectra(const float* kernel, float* spectra) {
  for (int w = 0; w < kWeights; w += kLanes)
    to_spectrum<2>([&](int y, int x) { return load(kernel + (y * 5 + x) * kWeights + w); },
                   [&](int n, Lanes value) { store(spectra + n * kWeights + w, scaled(value)); });
}

void deconv2_from_spectra(const float* spectra, float* kernel) {
  for (int w = 0; w < kWeights; w += kLanes)
    from_spectrum<2>(
        [&](int n) { return load(spectra + n * kWeights + w); },
        [&](int y, int x, Lanes value) { store(kernel + (y * 5 + x) * kWeights + w, scaled(value)); });
}

}  // namespace hbr::net
