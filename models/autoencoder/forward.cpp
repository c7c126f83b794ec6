#include "models/autoencoder/forward.h"

#include <type_traits>

namespace hbr::net {
namespace {

template <int N, class Activation>
HBR_INLINE void dense(const Network& network, LayerIndex which, const Lanes* in, Lanes* out,
                      Activation&& activation) {
  const Layer& layer = network.layer(which);
  for_blocks(layer.outputs, [&]<int B>(Index o) {
    Lanes sum[N][B];
    start(sum, network.bias(which) + o);
    multiply_add(sum, layer.inputs, in, kPlane, network.kernel(which) + o, layer.stride, 1);
    for (int v = 0; v < N; ++v)
      for (int b = 0; b < B; ++b) out[v * kPlane + o + b] = activation(sum[v][b]);
  });
}

// Convolution, max-pool and leaky rectifier (which commutes with the pool) at once.
template <int Taps, int In, int Size, int N, bool Training, class Rows>
HBR_INLINE void convolve_and_pool(const Lanes* in, int width, const float* weight, const float* bias,
                                  const Rows& rows, float leak, Lanes* out, IntLanes* winners) {
  constexpr int B = kConvolutionBlock<kMaps>;
  for (int y = 0; y < Size / 2; ++y)
    for (int x = 0; x < Size / 2; ++x)
      for (int o = 0; o < kMaps; o += B) {
        Lanes best[N][B] = {};
        IntLanes from[N][B] = {};
        for (int corner = 0; corner < 4; ++corner) {
          Lanes sum[N][B];
          start(sum, bias + o);
          convolve_pixel<Taps, In, kMaps, Size>(sum, in, kPlane, width, weight + o, 2 * y + corner / 2,
                                                2 * x + corner % 2, rows);
          for (int v = 0; v < N; ++v)
            for (int b = 0; b < B; ++b) {
              const auto better = corner == 0 ? IntLanes{} == 0 : sum[v][b] > best[v][b];
              best[v][b] = better ? sum[v][b] : best[v][b];
              if constexpr (Training) from[v][b] = better ? IntLanes{} + corner : from[v][b];
            }
        }
        const Index pixel = y * (Size / 2) + x;
        for (int v = 0; v < N; ++v) {
          for (int b = 0; b < B; ++b) out[v * kPlane + pixel * kMaps + o + b] = leaky(best[v][b], leak);
          if constexpr (Training) {
            IntLanes packed = o == 0 ? IntLanes{} : winners[v * kWinnersPlane + pixel];
            for (int b = 0; b < B; ++b) packed |= from[v][b] << (2 * (o + b));
            winners[v * kWinnersPlane + pixel] = packed;
          }
        }
      }
}

template <int N, bool Training>
void encode_tile(const Network& net, Tile<N>& tile) {
  const float leak = net.leak;
  const auto rectify = [leak](Lanes x) { return leaky(x, leak); };
  const auto spans = [&](int row) { return tile.spans[static_cast<std::size_t>(row)]; };
  convolve_and_pool<9, 1, kSide, N, Training>(tile.map(kImage) + kImageBorder, kImageWidth,
                                              net.kernel(kConv1), net.bias(kConv1), spans, leak,
                                              tile.map(kPool1), tile.winners + kWinners1);
  convolve_and_pool<3, kMaps, 14, N, Training>(tile.map(kPool1), 14, net.kernel(kConv2), net.bias(kConv2),
                                               WholeRow<14>{}, leak, tile.map(kPool2),
                                               tile.winners + kWinners2);
  dense<N>(net, kDense1, tile.map(kPool2), tile.map(kHidden1), rectify);
  dense<N>(net, kDense2, tile.map(kHidden1), tile.map(kHidden2), rectify);
  dense<N>(net, kLatent, tile.map(kHidden2), tile.map(kPosition), [](Lanes x) { return tanh(x); });
}

}  // namespace

template <int N, class Pixel>
void load_images(Tile<N>& tile, int count, const Pixel* const* images) {
  constexpr float scale = std::is_same_v<Pixel, float> ? 1.f : 1.f / 255.f;
  static constexpr Pixel black[kPixels] = {};
  tile.images = count;
  bool lit[kPixels] = {};
  for (int i = 0; i < count; ++i)
    for (int p = 0; p < kPixels; ++p) lit[p] |= images[i][p] != 0;
  for (int y = 0; y < kSide; ++y) {
    const bool* row = lit + y * kSide;
    const int begin = static_cast<int>(std::find(row, row + kSide, true) - row);
    int end = kSide;
    while (end > begin && !row[end - 1]) --end;
    tile.spans[static_cast<std::size_t>(y)] = {begin, end};
  }
  static_assert(kSide % 4 == 0 && kPixels % kLanes == 0);
  for (int v = 0; v < N; ++v) {
    const Pixel* source[kLanes];
    for (int l = 0; l < kLanes; ++l) source[l] = v * kLanes + l < count ? images[v * kLanes + l] : black;
    for (int p = 0; p < kPixels; p += kLanes) {
      Lanes block[kLanes];
      for (int l = 0; l < kLanes; ++l) {
        float row[kLanes];
        for (int k = 0; k < kLanes; ++k) row[k] = static_cast<float>(source[l][p + k]) * scale;
        block[l] = load(row);
      }
      transpose(block);
      for (int k = 0; k < kLanes; ++k)
        tile.map(kImage)[v * kPlane + (p + k) / kSide * kImageWidth + kImageBorder + (p + k) % kSide] =
            block[k];
    }
  }
}

template <int N>
void encode(const Network& network, Tile<N>& tile, bool training) {
  training ? encode_tile<N, true>(network, tile) : encode_tile<N, false>(network, tile);
}

template <int N>
void decode(const Network& net, Tile<N>& tile) {
  const float leak = net.leak;
  const auto rectify = [leak](Lanes x) { return leaky(x, leak); };
  dense<N>(net, kDense3, tile.map(kPosition), tile.map(kHidden3), rectify);
  dense<N>(net, kDense4, tile.map(kHidden3), tile.map(kHidden4), rectify);
  dense<N>(net, kDense5, tile.map(kHidden4), tile.map(kSeeds), rectify);
  convolve<3, kMaps, kMaps, 7, N>(tile.map(kSeeds), kPlane, net.kernel(kDeconv1), net.bias(kDeconv1),
                                  [&]<int B>(int y, int x, int o, Lanes(&sum)[N][B]) {
                                    for (int v = 0; v < N; ++v)
                                      for (int b = 0; b < B; ++b)
                                        tile.map(kGrown1)[v * kPlane + (y * 7 + x) * kMaps + o + b] =
                                            rectify(sum[v][b]);
                                  });
  convolve<5, kMaps, 4 * kMaps, 7, N>(
      tile.map(kGrown1), kPlane, net.deconv2.data(), net.deconv2_bias.data(),
      [&]<int B>(int y, int x, int o, Lanes(&sum)[N][B]) {
        const int parity = o / kMaps, channel = o % kMaps;
        const Index at = ((2 * y + parity / 2) * 14 + 2 * x + parity % 2) * kMaps + channel;
        for (int v = 0; v < N; ++v)
          for (int b = 0; b < B; ++b) tile.map(kGrown2)[v * kPlane + at + b] = rectify(sum[v][b]);
      });
  convolve<3, kMaps, 4, 14, N>(
      tile.map(kGrown2), kPlane, net.output.data(), net.output_bias.data(),
      [&](int y, int x, int, Lanes(&sum)[N][4]) {
        for (int v = 0; v < N; ++v)
          for (int b = 0; b < 4; ++b)
            tile.map(kDecoded)[v * kPlane + (2 * y + b / 2) * kSide + 2 * x + b % 2] = sigmoid(sum[v][b]);
      });
}

template <int N>
Lanes reconstruction_error(const Tile<N>& tile, int v) {
  const Lanes* image = tile.map(kImage) + v * kPlane;
  const Lanes* decoded = tile.map(kDecoded) + v * kPlane;
  Lanes sum{};
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const Lanes d = decoded[y * kSide + x] - image[y * kImageWidth + kImageBorder + x];
      sum += d * d;
    }
  return sum * (1.f / kPixels);
}

template void load_images(Tile<1>&, int, const float* const*);
template void load_images(Tile<2>&, int, const float* const*);
template void load_images(Tile<1>&, int, const std::uint8_t* const*);
template void load_images(Tile<2>&, int, const std::uint8_t* const*);
template void encode(const Network&, Tile<1>&, bool);
template void encode(const Network&, Tile<2>&, bool);
template void decode(const Network&, Tile<1>&);
template void decode(const Network&, Tile<2>&);
template Lanes reconstruction_error(const Tile<1>&, int);
template Lanes reconstruction_error(const Tile<2>&, int);

}  // namespace hbr::net
