#include "models/autoencoder/fourier.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "pipeline/core/random.h"

namespace hbr::net {
namespace {

Lanes random_lanes(Rng& rng) {
  Lanes x;
  for (int l = 0; l < kLanes; ++l) x[l] = static_cast<float>(rng.uniform(-1, 1));
  return x;
}

// The sum itself, in double precision: of the frequency (row, column), lane l.
template <int R>
std::pair<double, double> frequency(const Lanes (&map)[2 * R + 1][2 * R + 1], int row, int column, int l) {
  double re = 0, im = 0;
  for (int y = -R; y <= R; ++y)
    for (int x = -R; x <= R; ++x) {
      const double turn = 2 * std::numbers::pi * (row * y + column * x) / 9;
      re += map[R + y][R + x][l] * std::cos(turn);
      im -= map[R + y][R + x][l] * std::sin(turn);
    }
  return {re, im};
}

template <int R>
void expect_definition_and_round_trip() {
  Rng rng{Seed(R)};
  Lanes map[2 * R + 1][2 * R + 1], spectrum[kSpectrum];
  for (auto& row : map)
    for (Lanes& x : row) x = random_lanes(rng);
  std::multiset<int> written;
  to_spectrum<R>([&](int y, int x) { return map[y][x]; },
                 [&](int n, Lanes value) {
                   spectrum[n] = value;
                   written.insert(n);
                 });
  for (int n = 0; n < kSpectrum; ++n) EXPECT_EQ(written.count(n), 1u) << n;
  for (int l = 0; l < kLanes; ++l)
    for (int column = 0; column < 5; ++column)
      for (int row = column == 0 ? 0 : -4; row <= 4; ++row) {
        const int n = fourier::number_of(row, column);
        const auto [re, im] = frequency<R>(map, row, column, l);
        EXPECT_NEAR(spectrum[n][l], re, 2e-6);
        EXPECT_NEAR(n > 0 ? spectrum[n + 1][l] : 0.f, im, 2e-6) << row << ' ' << column;
      }
  from_spectrum<R>([&](int n) { return spectrum[n]; },
                   [&](int y, int x, Lanes value) {
                     for (int l = 0; l < kLanes; ++l)
                       EXPECT_NEAR(value[l] / kSpectrum, map[y][x][l], 1e-6) << y << ' ' << x;
                   });
}

TEST(Fourier, SpectraAreTheirDefinitionAndLeadBack) {
  expect_definition_and_round_trip<2>();
  expect_definition_and_round_trip<3>();
}

// y[p] = sum of x[p + t] w[t], place by place in double precision, borders left out.
TEST(Fourier, ProductsOfSpectraAreConvolutions) {
  constexpr int kOut = 4 * kMaps, kWeights = kMaps * kOut;
  Rng rng{Seed(7)};
  Floats kernel(kSubpixelDeconv2), spectra(kDeconv2Spectra);
  for (float& w : kernel) w = static_cast<float>(rng.uniform(-1, 1));
  deconv2_to_spectra(kernel.data(), spectra.data());
  std::vector<Lanes> maps(49 * kMaps), below(kSpectrum * kMaps), above(kSpectrum * kOut);
  for (Lanes& x : maps) x = random_lanes(rng);

  const auto expected = [&](int y, int x, int o, int l) {
    double sum = 0;
    for (int dy = -2; dy <= 2; ++dy)
      for (int dx = -2; dx <= 2; ++dx)
        if (y + dy >= 0 && y + dy < 7 && x + dx >= 0 && x + dx < 7)
          for (int i = 0; i < kMaps; ++i)
            sum += static_cast<double>(maps[((y + dy) * 7 + x + dx) * kMaps + i][l]) *
                   kernel[((dy + 2) * 5 + dx + 2) * kWeights + i * kOut + o];
    return sum;
  };
  maps_to_spectra<kMaps>(maps.data(), below.data());
  multiply_spectra<kMaps, kOut, true>(below.data(), spectra.data(), kWeights, kOut, 1, above.data());
  int stored = 0;
  double error = 0;
  spectra_to_maps<kOut>(above.data(), [&](int y, int x, int o, Lanes value) {
    ++stored;
    for (int l = 0; l < kLanes; ++l) error = std::max(error, std::abs(value[l] - expected(y, x, o, l)));
  });
  EXPECT_EQ(stored, 49 * kOut);
  EXPECT_LT(error, 1e-5);  // of sums of 200 products

  Floats back(kSubpixelDeconv2, 0.f);
  deconv2_from_spectra(spectra.data(), back.data());
  for (std::size_t k = 0; k < kernel.size(); ++k) ASSERT_NEAR(back[k] * kSpectrum, kernel[k], 2e-5f);
}

}  // namespace
}  // namespace hbr::net
