// The first convolution with its max-pool, and its gradient, image by image: most of an image is black, and
// only what lies between the first and the last lit pixel of a row is worked on. A vector holds the channels
// of one pixel or of two neighbours, or half of one's.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "models/autoencoder/kernels.h"

namespace hbr::net {

namespace conv1 {

inline constexpr int kTaps = 9, kHalf = kTaps / 2;
inline constexpr int kGroup = std::max(1, kLanes / kMaps);  // pixels that begin a vector together
inline constexpr int kReach = kGroup + 2 * kHalf;           // pixels that a group's taps reach
inline constexpr int kVectors = kReach * kMaps / kLanes;    // vectors of these
inline constexpr int kRow = (kSide + 2 * kHalf) * kMaps;    // floats of a row of maps, with its borders
inline constexpr int kPooled = kSide / 2 * (kSide / 2) * kMaps;

// The maps before the max-pool of one image, and what belongs to them after it, of all images of a plane.
struct Room {
  float* row(int y) { return rows[y >= 0 && y < kSide ? y : kSide]; }

  alignas(64) float rows[kSide + 1][kRow] = {};  // the last one stands for those outside
  alignas(64) float pooled[kLanes][kPooled];
};

}  // namespace conv1

// Columns of a row.
struct Span {
  int begin, end;
};

// One image of a tile by itself.
struct LitImage {
  // To be called when the pixels have changed.
  void find_spans();

  float pixels[kPixels];
  std::array<Span, kSide> spans;  // the columns of each row outside of which it is black
  // Which of four pixels won the max-pool (row * 2 + column; the first of equals).
  std::uint8_t winners[conv1::kPooled];
};

// The kernel {9, 9, 1, 8} as the convolution reads it: for each row of taps and each pixel of a group what it
// adds to the group's reach.
inline constexpr int kConv1Spread = conv1::kTaps * conv1::kGroup * conv1::kReach * kMaps;
void spread_conv1(const float* kernel, float* spread);

// Of the images of a plane, to pooled [14][14][8], after the units; finds the winners where asked.
void convolve_and_pool(LitImage* images, const float* spread, const float* bias, const HiddenUnits& unit,
                       bool find_winners, conv1::Room& room, Lanes* pooled);

class Conv1Gradient {
 public:
  // Adds the gradient of `count` images of a plane; slopes [14][14][8] are those of what leaves the max-pool.
  void add(const LitImage* images, int count, const Lanes* slopes, conv1::Room& room);
  // Adds what has come together to gradient {9, 9, 1, 8}, and begins anew.
  void finish(float* gradient);

 private:
  template <int Rows>
  void add_taps(const LitImage& image, int first, conv1::Room& room);

  Lanes sums_[conv1::kTaps][conv1::kGroup][conv1::kVectors] = {};
};

}  // namespace hbr::net
