#include "models/autoencoder/conv1.h"

#include <bit>

namespace hbr::net {
namespace {

using namespace conv1;

constexpr int kSmall = kSide / 2;  // pixels a side after the max-pool

// The channels of one pixel, whatever the width of the other vectors.
using Channels [[gnu::vector_size(kMaps * 4)]] = float;
using IntChannels [[gnu::vector_size(kMaps * 4)]] = std::int32_t;
using ByteChannels [[gnu::vector_size(kMaps)]] = std::uint8_t;

Channels channels(const float* from) {
  Channels x;
  std::memcpy(&x, from, sizeof x);
  return x;
}

// What the row of taps `w` [kGroup][kVectors] adds to a row of maps for the pixels of a span. A vector of
// maps is loaded when the first pixel reaches it, and stored when the last one has left it.
HBR_INLINE void add_row(const float* pixels, Span span, const Lanes (&w)[kGroup][kVectors], float* to) {
  constexpr int step = kGroup * kMaps / kLanes;
  const int begin = span.begin & -kGroup;
  Lanes sum[kVectors];
#pragma GCC unroll 18
  for (int v = 0; v < kVectors - step; ++v) sum[v] = load(to + begin * kMaps + v * kLanes);
  int x = begin;
  for (; x < span.end; x += kGroup) {
    float* const here = to + x * kMaps;
#pragma GCC unroll 2
    for (int v = kVectors - step; v < kVectors; ++v) sum[v] = load(here + v * kLanes);
#pragma GCC unroll 2
    for (int g = 0; g < kGroup; ++g) {
      const Lanes pixel = broadcast(pixels[x + g]);
#pragma GCC unroll 18
      for (int v = 0; v < kVectors; ++v) sum[v] += pixel * w[g][v];
    }
#pragma GCC unroll 2
    for (int v = 0; v < step; ++v) store(here + v * kLanes, sum[v]);
#pragma GCC unroll 18
    for (int v = 0; v < kVectors - step; ++v) sum[v] = sum[v + step];
  }
#pragma GCC unroll 18
  for (int v = 0; v < kVectors - step; ++v) store(to + x * kMaps + v * kLanes, sum[v]);
}

void convolve(const LitImage& image, const float* spread, Room& room) {
  std::fill_n(room.rows[0], kSide * kRow, 0.f);
  for (int ky = 0; ky < kTaps; ++ky) {
    Lanes w[kGroup][kVectors];
    for (int g = 0; g < kGroup; ++g)
      for (int v = 0; v < kVectors; ++v) w[g][v] = load(spread + ((ky * kGroup + g) * kVectors + v) * kLanes);
    for (int y = std::max(0, ky - kHalf); y < std::min(kSide, kSide + ky - kHalf); ++y) {
      const Span span = image.spans[static_cast<std::size_t>(y)];
      if (span.begin < span.end) add_row(image.pixels + y * kSide, span, w, room.rows[y - ky + kHalf]);
    }
  }
}

template <bool Winners>
HBR_INLINE void pool(const Room& room, const float* bias, float* pooled, std::uint8_t* winners) {
  for (int y = 0; y < kSmall; ++y)
    for (int x = 0; x < kSmall; ++x) {
      const float* from = room.rows[2 * y] + (2 * x + kHalf) * kMaps;
      Channels best = channels(from);
      IntChannels winner{};
#pragma GCC unroll 3
      for (int corner = 1; corner < 4; ++corner) {
        const Channels other = channels(from + corner / 2 * kRow + corner % 2 * kMaps);
        const auto better = other > best;
        best = better ? other : best;
        if constexpr (Winners) winner = better ? IntChannels{} + corner : winner;
      }
      best = best + channels(bias);
      const int to = (y * kSmall + x) * kMaps;
      std::memcpy(pooled + to, &best, sizeof best);
      if constexpr (Winners) {
        const auto bytes = __builtin_convertvector(winner, ByteChannels);
        std::memcpy(winners + to, &bytes, sizeof bytes);
      }
    }
}

}  // namespace

void LitImage::find_spans() {
  for (int y = 0; y < kSide; ++y) {
    std::uint32_t lit = 0;  // a bit for each column
    for (int x = 0; x < kSide; ++x) lit |= (pixels[y * kSide + x] != 0 ? 1u : 0u) << x;
    spans[static_cast<std::size_t>(y)] = {std::min(std::countr_zero(lit), kSide), 32 - std::countl_zero(lit)};
  }
}

// A group's pixel g sees the column j of its reach through the tap g - j + 2 kHalf.
void spread_conv1(const float* kernel, float* spread) {
  std::fill_n(spread, kConv1Spread, 0.f);
  for (int ky = 0; ky < kTaps; ++ky)
    for (int g = 0; g < kGroup; ++g)
      for (int kx = 0; kx < kTaps; ++kx)
        std::copy_n(kernel + (ky * kTaps + kx) * kMaps, kMaps,
                    spread + ((ky * kGroup + g) * kReach + g - kx + 2 * kHalf) * kMaps);
}

void convolve_and_pool(LitImage* images, const float* spread, const float* bias, const HiddenUnits& unit,
                       bool find_winners, Room& room, Lanes* pooled) {
  for (int l = 0; l < kLanes; ++l) {
    convolve(images[l], spread, room);
    if (find_winners)
      pool<true>(room, bias, room.pooled[l], images[l].winners);
    else
      pool<false>(room, bias, room.pooled[l], nullptr);
  }
  for (int i = 0; i < kPooled; i += kLanes) {
    Lanes block[kLanes];
    for (int l = 0; l < kLanes; ++l) block[l] = load(room.pooled[l] + i);
    transpose(block);
    for (int l = 0; l < kLanes; ++l) pooled[i + l] = unit(block[l]);
  }
}

namespace {

// Slopes before the max-pool: those of the winners, elsewhere zero.
void unpool(const float* slopes, const std::uint8_t* winners, Room& room) {
  for (int y = 0; y < kSmall; ++y)
    for (int x = 0; x < kSmall; ++x) {
      const int at = (y * kSmall + x) * kMaps;
      const Channels slope = channels(slopes + at);
      ByteChannels bytes;
      std::memcpy(&bytes, winners + at, sizeof bytes);
      const auto winner = __builtin_convertvector(bytes, IntChannels);
      float* const to = room.rows[2 * y] + (2 * x + kHalf) * kMaps;
#pragma GCC unroll 4
      for (int corner = 0; corner < 4; ++corner) {
        const Channels won = winner == corner ? slope : Channels{};
        std::memcpy(to + corner / 2 * kRow + corner % 2 * kMaps, &won, sizeof won);
      }
    }
}

}  // namespace

// The rows of taps from `first` on.
template <int Rows>
void Conv1Gradient::add_taps(const LitImage& image, int first, Room& room) {
  constexpr int chunk = std::min(kVectors, 9);  // vectors that stay in registers
  for (int c = 0; c < kVectors; c += chunk) {
    Lanes sum[Rows][kGroup][chunk];
    for (int r = 0; r < Rows; ++r)
      for (int g = 0; g < kGroup; ++g)
        for (int v = 0; v < chunk; ++v) sum[r][g][v] = sums_[first + r][g][c + v];
    for (int y = 0; y < kSide; ++y) {
      const Span span = image.spans[static_cast<std::size_t>(y)];
      const float* from[Rows];
      for (int r = 0; r < Rows; ++r) from[r] = room.row(y - first - r + kHalf) + c * kLanes;
      for (int x = span.begin & -kGroup; x < span.end; x += kGroup) {
        Lanes pixel[kGroup];
#pragma GCC unroll 2
        for (int g = 0; g < kGroup; ++g) pixel[g] = broadcast(image.pixels[y * kSide + x + g]);
#pragma GCC unroll 2
        for (int r = 0; r < Rows; ++r)
#pragma GCC unroll 9
          for (int v = 0; v < chunk; ++v) {
            const Lanes slope = load(from[r] + x * kMaps + v * kLanes);
#pragma GCC unroll 2
            for (int g = 0; g < kGroup; ++g) sum[r][g][v] += slope * pixel[g];
          }
      }
    }
    for (int r = 0; r < Rows; ++r)
      for (int g = 0; g < kGroup; ++g)
        for (int v = 0; v < chunk; ++v) sums_[first + r][g][c + v] = sum[r][g][v];
  }
}

void Conv1Gradient::add(const LitImage* images, int count, const Lanes* slopes, Room& room) {
  std::fill_n(room.rows[0], (kSide + 1) * kRow, 0.f);
  for (int i = 0; i < kPooled; i += kLanes) {
    Lanes block[kLanes];
    std::copy_n(slopes + i, kLanes, block);
    transpose(block);
    for (int l = 0; l < kLanes; ++l) store(room.pooled[l] + i, block[l]);
  }
  constexpr int rows = kLanes > kMaps ? 2 : 1;
  for (int l = 0; l < count; ++l) {
    unpool(room.pooled[l], images[l].winners, room);
    int ky = 0;
    for (; ky + rows <= kTaps; ky += rows) add_taps<rows>(images[l], ky, room);
    if constexpr (kTaps % rows > 0) add_taps<kTaps % rows>(images[l], ky, room);
  }
}

void Conv1Gradient::finish(float* gradient) {
  for (int ky = 0; ky < kTaps; ++ky)
    for (int g = 0; g < kGroup; ++g) {
      float reach[kReach * kMaps];
      for (int v = 0; v < kVectors; ++v) store(reach + v * kLanes, sums_[ky][g][v]);
      for (int kx = 0; kx < kTaps; ++kx)
        for (int c = 0; c < kMaps; ++c)
          gradient[(ky * kTaps + kx) * kMaps + c] += reach[(g - kx + 2 * kHalf) * kMaps + c];
    }
  std::fill_n(&sums_[0][0][0], kTaps * kGroup * kVectors, Lanes{});
}

}  // namespace hbr::net
