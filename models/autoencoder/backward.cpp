#include "models/autoencoder/backward.h"

#include "models/autoencoder/gradient_kernels.h"

namespace hbr::net {
namespace {

// The last layer's kernel in sub-pixel form; each parity has four of the nine taps. slope [28][28].
void output_gradient(const Lanes* in, const Lanes* slope, float* gradient) {
  for (int parity = 0; parity < 4; ++parity)
    for (int corner = 0; corner < 4; ++corner) {
      const int py = parity / 2, px = parity % 2, dy = py + corner / 2 - 1, dx = px + corner % 2 - 1;
      Lanes sum[kMaps] = {};
      for (int v = 0; v < kPlanes; ++v)
        for (int y = std::max(0, -dy); y < std::min(14, 14 - dy); ++y)
          for (int x = std::max(0, -dx); x < std::min(14, 14 - dx); ++x) {
            const Lanes s = slope[v * kSlopePlane + (2 * y + py) * kSide + 2 * x + px];
            const Lanes* a = in + v * kPlane + ((y + dy) * 14 + x + dx) * kMaps;
#pragma GCC unroll 8
            for (int c = 0; c < kMaps; ++c) sum[c] += s * a[c];
          }
      float total[kMaps] = {};
      add_lane_sums(sum, total);
      for (int c = 0; c < kMaps; ++c)
        gradient[(((dy + 1) * 3 + dx + 1) * kMaps + c) * 4 + parity] += total[c];
    }
}

// From the slopes of the decoded pixels to those of the 14 x 14 maps below: store(y, x, first channel, sum).
template <class Store>
HBR_INLINE void output_backward(const Network& net, const Lanes* slope, Store&& store) {
  for (int y = 0; y < 14; ++y)
    for (int x = 0; x < 14; ++x)
      for (int o = 0; o < kMaps; o += kConvolutionBlock<kMaps>) {
        Lanes sum[kPlanes][kConvolutionBlock<kMaps>];
        start(sum, nullptr);
        const int first = x == 0 ? 1 : 0, last = x == 13 ? 3 : 4;
        for (int row = y == 0 ? 1 : 0; row < (y == 13 ? 3 : 4); ++row)
          multiply_add(sum, last - first, slope + (2 * y - 1 + row) * kSide + 2 * x - 1 + first, kSlopePlane,
                       net.output_back.data() + (row * 4 + first) * kMaps + o, kMaps, 1);
        store(y, x, o, sum);
      }
}

// The sub-pixel convolution of one plane, by spectra: from those of its inputs and of its slopes adds to the
// spectrum of its kernel's gradient [number][8 inputs][32 outputs].
inline void deconv2_gradient(const Lanes* in, const Lanes* slope, float* gradient) {
  constexpr int outputs = 4 * kMaps, O = std::min(2, outputs / kLanes), I = kBlock / 2;
  float re[kLanes * outputs], im[kLanes * outputs];  // slopes of one frequency, one row per image
  const auto for_gradient = [&](auto&& body) {
    for (int i = 0; i < kMaps; i += I)
      for (int o = 0; o < outputs; o += O * kLanes) body(i, o);
  };
  images_to_rows(slope, outputs, re, outputs);
  for_gradient([&](int i, int o) {
    update_block<I, O>(gradient + i * outputs + o, outputs,
                       [&](Lanes(&sum)[I][O]) { outer_product(sum, in + i, re + o, outputs); });
  });
  for (int n = 1; n < kSpectrum; n += 2) {
    images_to_rows(slope + n * outputs, outputs, re, outputs);
    images_to_rows(slope + (n + 1) * outputs, outputs, im, outputs);
    for_gradient([&](int i, int o) {
      float* const to = gradient + (n * kMaps + i) * outputs + o;
      update_block<I, O>(to, outputs, [&](Lanes(&real)[I][O]) {
        update_block<I, O>(to + kMaps * outputs, outputs, [&](Lanes(&imaginary)[I][O]) {
          conjugate_outer_product(real, imaginary, in + n * kMaps + i, in + (n + 1) * kMaps + i, re + o,
                                  im + o, outputs);
        });
      });
    });
  }
}

// A dense layer: from the slopes of its outputs to those of what it read, `in`, whose activation's derivative
// is `derivative(activation)`; the slopes go to the record, too.
template <class Derivative>
HBR_INLINE void dense_backward(const Network& net, LayerIndex which, const Lanes* in, Slopes& slopes,
                               SlopeMap from, SlopeMap to, DenseRecord& record, Derivative&& derivative) {
  const Layer& layer = net.layer(which);
  const Lanes* slope = slopes.map(from);
  float* const rows = record.rows(net.layout, which);
  for (int v = 0; v < kPlanes; ++v)
    images_to_rows(slope + v * kSlopePlane, layer.outputs, rows + v * kLanes * layer.stride, layer.stride);
  Lanes* below = slopes.map(to);
  for_blocks(layer.inputs, [&]<int B>(Index k) {
    Lanes sum[kPlanes][B];
    start(sum, nullptr);
    multiply_add(sum, layer.outputs, slope, kSlopePlane, net.kernel(which) + k * layer.stride, 1,
                 layer.stride);
    for (int v = 0; v < kPlanes; ++v)
      for (int b = 0; b < B; ++b)
        below[v * kSlopePlane + k + b] = sum[v][b] * derivative(in[v * kPlane + k + b]);
  });
}

// The slopes before the second max-pool: those of the winners, elsewhere zero.
HBR_INLINE void unpool(const Lanes* pooled, const IntLanes* winners, Lanes* slopes) {
  for (int v = 0; v < kPlanes; ++v)
    for (int y = 0; y < 14; ++y)
      for (int x = 0; x < 14; ++x) {
        const Index pixel = y / 2 * 7 + x / 2;
        const int corner = y % 2 * 2 + x % 2;
        for (int c = 0; c < kMaps; ++c) {
          const auto won = (winners[v * 7 * 7 + pixel] & (3 << (2 * c))) == (corner << (2 * c));
          slopes[v * kSlopePlane + (y * 14 + x) * kMaps + c] =
              won ? pooled[v * kSlopePlane + pixel * kMaps + c] : Lanes{};
        }
      }
}

}  // namespace

void backward(const Network& net, Tile& tile, Slopes& slopes, float scale, DenseRecord& record,
              float* gradient) {
  const HiddenUnits unit(net.activations);
  const auto slope_of = [&unit](Lanes y) { return unit.slope(y); };
  const bool linear = net.activations.linear_output;
  float* const to_deconv2 = gradient + net.layout.size;
  float* const to_output = to_deconv2 + kDeconv2Spectra;
  const auto weights = [&](LayerIndex i) { return gradient + net.layer(i).kernel; };
  const auto bias = [&](LayerIndex i) { return gradient + net.layer(i).bias; };

  // Output: its units and the squared error.
  for (int v = 0; v < kPlanes; ++v) {
    Lanes factor;
    for (int l = 0; l < kLanes; ++l) factor[l] = v * kLanes + l < tile.images ? scale * (2.f / kPixels) : 0.f;
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const Lanes out = tile.map(kDecoded)[v * kPlane + y * kSide + x];
        const Lanes in = tile.map(kImage)[v * kPlane + y * kSide + x];
        slopes.map(kOutputSlope)[v * kSlopePlane + y * kSide + x] =
            linear ? (out - in) * factor : (out - in) * out * (1.f - out) * factor;
      }
  }
  output_gradient(tile.map(kGrown2), slopes.map(kOutputSlope), to_output);
  bias_gradient<1, kPlanes>(slopes.map(kOutputSlope), kSlopePlane, kPixels, bias(kOutput));

  // Decoder's convolutions.
  output_backward(net, slopes.map(kOutputSlope), [&]<int B>(int y, int x, int o, Lanes(&sum)[kPlanes][B]) {
    const Index from = (y * 14 + x) * kMaps + o;
    const Index to = ((y / 2 * 7 + x / 2) * 4 + y % 2 * 2 + x % 2) * kMaps + o;
    for (int v = 0; v < kPlanes; ++v)
      for (int b = 0; b < B; ++b)
        slopes.map(kGrown2Slope)[v * kSlopePlane + to + b] =
            sum[v][b] * slope_of(tile.map(kGrown2)[v * kPlane + from + b]);
  });
  const auto keep = [&](Map activation, SlopeMap slope, int size) {
    return [&, activation, slope, size]<int B>(int y, int x, int o, Lanes(&sum)[kPlanes][B]) {
      const Index at = (y * size + x) * kMaps + o;
      for (int v = 0; v < kPlanes; ++v)
        for (int b = 0; b < B; ++b)
          slopes.map(slope)[v * kSlopePlane + at + b] =
              sum[v][b] * slope_of(tile.map(activation)[v * kPlane + at + b]);
    };
  };
  bias_gradient<kMaps, kPlanes>(slopes.map(kGrown2Slope), kSlopePlane, 14 * 14, bias(kDeconv2));
  for (int v = 0; v < kPlanes; ++v) {
    maps_to_spectra<4 * kMaps>(slopes.map(kGrown2Slope) + v * kSlopePlane, tile.above);
    deconv2_gradient(tile.below + v * kSpectrum * kMaps, tile.above, to_deconv2);
    multiply_spectra<4 * kMaps, kMaps, false>(tile.above, net.deconv2_spectra.data(), 4 * kMaps * kMaps, 1,
                                              4 * kMaps, slopes.below);
    spectra_to_maps<kMaps>(slopes.below, [&](int y, int x, int c, Lanes sum) {
      const Index at = (y * 7 + x) * kMaps + c;
      slopes.map(kGrown1Slope)[v * kSlopePlane + at] = sum * slope_of(tile.map(kGrown1)[v * kPlane + at]);
    });
  }
  kernel_gradient<3, kMaps, kMaps, 7, kPlanes>(tile.map(kSeeds), kPlane, slopes.map(kGrown1Slope),
                                               kSlopePlane, weights(kDeconv1));
  bias_gradient<kMaps, kPlanes>(slopes.map(kGrown1Slope), kSlopePlane, 7 * 7, bias(kDeconv1));
  convolve<3, kMaps, kMaps, 7, kPlanes>(slopes.map(kGrown1Slope), kSlopePlane, net.deconv1_back.data(),
                                        nullptr, keep(kSeeds, kSeedsSlope, 7));

  // Dense layers.
  for (int v = 0; v < kPlanes; ++v)
    std::copy_n(tile.map(kPool2) + v * kPlane, kDenseInputs, record.inputs + v * kDenseInputs);
  dense_backward(net, kDense5, tile.map(kHidden4), slopes, kSeedsSlope, kHidden4Slope, record, slope_of);
  dense_backward(net, kDense4, tile.map(kHidden3), slopes, kHidden4Slope, kHidden3Slope, record, slope_of);
  dense_backward(net, kDense3, tile.map(kPosition), slopes, kHidden3Slope, kPositionSlope, record,
                 [](Lanes y) { return tanh_slope(y); });
  dense_backward(net, kLatent, tile.map(kHidden2), slopes, kPositionSlope, kHidden2Slope, record, slope_of);
  dense_backward(net, kDense2, tile.map(kHidden1), slopes, kHidden2Slope, kHidden1Slope, record, slope_of);
  dense_backward(net, kDense1, tile.map(kPool2), slopes, kHidden1Slope, kPool2Slope, record, slope_of);

  // Encoder's convolutions.
  unpool(slopes.map(kPool2Slope), tile.winners, slopes.map(kConv2Slope));
  kernel_gradient<3, kMaps, kMaps, 14, kPlanes>(tile.map(kPool1), kPlane, slopes.map(kConv2Slope),
                                                kSlopePlane, weights(kConv2));
  bias_gradient<kMaps, kPlanes>(slopes.map(kPool2Slope), kSlopePlane, 7 * 7, bias(kConv2));
  convolve<3, kMaps, kMaps, 14, kPlanes>(slopes.map(kConv2Slope), kSlopePlane, net.conv2_back.data(), nullptr,
                                         keep(kPool1, kPool1Slope, 14));
  for (int v = 0; v < kPlanes; ++v)
    slopes.conv1.add(tile.lit + v * kLanes, std::clamp(tile.images - v * kLanes, 0, kLanes),
                     slopes.map(kPool1Slope) + v * kSlopePlane, tile.room);
  slopes.conv1.finish(weights(kConv1));
  bias_gradient<kMaps, kPlanes>(slopes.map(kPool1Slope), kSlopePlane, 14 * 14, bias(kConv1));
}

}  // namespace hbr::net
