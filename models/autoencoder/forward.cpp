#include "models/autoencoder/forward.h"

#include <cmath>
#include <utility>

namespace hbr::net {
namespace {

template <class Activation>
HBR_INLINE void dense(const Network& network, LayerIndex which, const Lanes* in, Lanes* out,
                      Activation&& activation) {
  const Layer& layer = network.layer(which);
  for_blocks(layer.outputs, [&]<int B>(Index o) {
    Lanes sum[kPlanes][B];
    start(sum, network.bias(which) + o);
    multiply_add(sum, layer.inputs, in, kPlane, network.kernel(which) + o, layer.stride, 1);
    for (int v = 0; v < kPlanes; ++v)
      for (int b = 0; b < B; ++b) out[v * kPlane + o + b] = activation(sum[v][b]);
  });
}

// The second convolution, its max-pool and its units (which commute with the pool) at once.
template <bool Training>
HBR_INLINE void convolve_and_pool(const Lanes* in, const float* weight, const float* bias,
                                  const HiddenUnits& unit, Lanes* out, IntLanes* winners) {
  constexpr int B = kConvolutionBlock<kMaps>;
  for (int y = 0; y < 7; ++y)
    for (int x = 0; x < 7; ++x)
      for (int o = 0; o < kMaps; o += B) {
        Lanes best[kPlanes][B] = {};
        IntLanes from[kPlanes][B] = {};
        for (int corner = 0; corner < 4; ++corner) {
          Lanes sum[kPlanes][B];
          start(sum, bias + o);
          convolve_pixel<3, kMaps, kMaps, 14>(sum, in, kPlane, weight + o, 2 * y + corner / 2,
                                              2 * x + corner % 2);
          for (int v = 0; v < kPlanes; ++v)
            for (int b = 0; b < B; ++b) {
              const auto better = corner == 0 ? IntLanes{} == 0 : sum[v][b] > best[v][b];
              best[v][b] = better ? sum[v][b] : best[v][b];
              if constexpr (Training) from[v][b] = better ? IntLanes{} + corner : from[v][b];
            }
        }
        const Index pixel = y * 7 + x;
        for (int v = 0; v < kPlanes; ++v) {
          for (int b = 0; b < B; ++b) out[v * kPlane + pixel * kMaps + o + b] = unit(best[v][b]);
          if constexpr (Training) {
            IntLanes packed = o == 0 ? IntLanes{} : winners[v * 7 * 7 + pixel];
            for (int b = 0; b < B; ++b) packed |= from[v][b] << (2 * (o + b));
            winners[v * 7 * 7 + pixel] = packed;
          }
        }
      }
}

template <bool Training>
void encode_tile(const Network& net, Tile& tile) {
  const HiddenUnits unit(net.activations);
  for (int v = 0; v < kPlanes; ++v)
    convolve_and_pool(tile.lit + v * kLanes, net.conv1_spread.data(), net.bias(kConv1), unit, Training,
                      tile.room, tile.map(kPool1) + v * kPlane);
  convolve_and_pool<Training>(tile.map(kPool1), net.kernel(kConv2), net.bias(kConv2), unit, tile.map(kPool2),
                              tile.winners);
  dense(net, kDense1, tile.map(kPool2), tile.map(kHidden1), unit);
  dense(net, kDense2, tile.map(kHidden1), tile.map(kHidden2), unit);
  dense(net, kLatent, tile.map(kHidden2), tile.map(kPosition), [](Lanes x) { return tanh(x); });
}

// The last convolution in sub-pixel form on 14 x 14 maps, and the output's units. Of its nine taps each
// parity sees four.
HBR_INLINE void decode_output(const Network& net, const Lanes* in, Lanes* decoded) {
  const bool linear = net.activations.linear_output;
  for (int y = 0; y < 14; ++y)
    for (int x = 0; x < 14; ++x) {
      Lanes sum[kPlanes][4];
      start(sum, net.output_bias.data());
      const auto add_tap = [&]<int Tap>(std::integral_constant<int, Tap>) {
        constexpr int dy = Tap / 3 - 1, dx = Tap % 3 - 1;
        if (y + dy < 0 || y + dy > 13 || x + dx < 0 || x + dx > 13) return;
        const Lanes* from = in + ((y + dy) * 14 + x + dx) * kMaps;
        const float* weight = net.output.data() + Tap * kMaps * 4;
#pragma GCC unroll 8
        for (int c = 0; c < kMaps; ++c)
#pragma GCC unroll 4
          for (int parity = 0; parity < 4; ++parity)
            if ((parity / 2 ? dy >= 0 : dy <= 0) && (parity % 2 ? dx >= 0 : dx <= 0)) {
              const Lanes w = broadcast(weight[c * 4 + parity]);
#pragma GCC unroll 4
              for (int v = 0; v < kPlanes; ++v) sum[v][parity] += w * from[v * kPlane + c];
            }
      };
      [&]<int... Tap>(std::integer_sequence<int, Tap...>) {
        (add_tap(std::integral_constant<int, Tap>()), ...);
      }
      (std::make_integer_sequence<int, 9>());
      for (int v = 0; v < kPlanes; ++v)
        for (int parity = 0; parity < 4; ++parity)
          decoded[v * kPlane + (2 * y + parity / 2) * kSide + 2 * x + parity % 2] =
              linear ? sum[v][parity] : sigmoid(sum[v][parity]);
    }
}

float brightness(float pixel) { return pixel; }
float brightness(std::uint8_t pixel) { return static_cast<float>(pixel) * (1.f / 255.f); }

}  // namespace

template <class Pixel>
void load_images(Tile& tile, int count, const Pixel* const* images) {
  static constexpr Pixel black[kPixels] = {};
  tile.images = count;
  static_assert(kPixels % kLanes == 0);
  for (int v = 0; v < kPlanes; ++v) {
    LitImage* const lit = tile.lit + v * kLanes;
    for (int l = 0; l < kLanes; ++l) {
      const Pixel* image = v * kLanes + l < count ? images[v * kLanes + l] : black;
      for (int p = 0; p < kPixels; ++p) lit[l].pixels[p] = brightness(image[p]);
      lit[l].find_spans();
    }
    for (int p = 0; p < kPixels; p += kLanes) {
      Lanes block[kLanes];
      for (int l = 0; l < kLanes; ++l) block[l] = load(lit[l].pixels + p);
      transpose(block);
      for (int k = 0; k < kLanes; ++k) tile.map(kImage)[v * kPlane + p + k] = block[k];
    }
  }
}

void encode(const Network& network, Tile& tile, bool training) {
  training ? encode_tile<true>(network, tile) : encode_tile<false>(network, tile);
}

void decode(const Network& net, Tile& tile) {
  const HiddenUnits unit(net.activations);
  dense(net, kDense3, tile.map(kPosition), tile.map(kHidden3), unit);
  dense(net, kDense4, tile.map(kHidden3), tile.map(kHidden4), unit);
  dense(net, kDense5, tile.map(kHidden4), tile.map(kSeeds), unit);
  convolve<3, kMaps, kMaps, 7, kPlanes>(tile.map(kSeeds), kPlane, net.kernel(kDeconv1), net.bias(kDeconv1),
                                        [&]<int B>(int y, int x, int o, Lanes(&sum)[kPlanes][B]) {
                                          for (int v = 0; v < kPlanes; ++v)
                                            for (int b = 0; b < B; ++b)
                                              tile.map(kGrown1)[v * kPlane + (y * 7 + x) * kMaps + o + b] =
                                                  unit(sum[v][b]);
                                        });
  for (int v = 0; v < kPlanes; ++v) {
    Lanes* const below = tile.below + v * kSpectrum * kMaps;
    maps_to_spectra<kMaps>(tile.map(kGrown1) + v * kPlane, below);
    multiply_spectra<kMaps, 4 * kMaps, true>(below, net.deconv2_spectra.data(), 4 * kMaps * kMaps, 4 * kMaps,
                                             1, tile.above);
    spectra_to_maps<4 * kMaps>(tile.above, [&](int y, int x, int o, Lanes sum) {
      const int parity = o / kMaps, channel = o % kMaps;
      const Index at = ((2 * y + parity / 2) * 14 + 2 * x + parity % 2) * kMaps + channel;
      tile.map(kGrown2)[v * kPlane + at] = unit(sum + net.bias(kDeconv2)[channel]);
    });
  }
  decode_output(net, tile.map(kGrown2), tile.map(kDecoded));
}

Lanes reconstruction_error(const Tile& tile, int v) {
  const Lanes* image = tile.map(kImage) + v * kPlane;
  const Lanes* decoded = tile.map(kDecoded) + v * kPlane;
  Lanes sum{};
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const Lanes d = decoded[y * kSide + x] - image[y * kSide + x];
      sum += d * d;
    }
  return sum * (1.f / kPixels);
}

template void load_images(Tile&, int, const float* const*);
template void load_images(Tile&, int, const std::uint8_t* const*);

}  // namespace hbr::net
