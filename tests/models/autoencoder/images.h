// Images for tests: soft random strokes on black, with a black frame of changing width.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "pipeline/core/random.h"

namespace hbr {

inline std::vector<std::uint8_t> stroke_images(int n, Seed seed) {
  std::vector<std::uint8_t> images(static_cast<std::size_t>(n) * 784, 0);
  for (int i = 0; i < n; ++i) {
    Rng rng(seed.child(static_cast<std::uint64_t>(i)));
    const int frame = static_cast<int>(rng.below(8));
    float x = rng.uniform(8, 20), y = rng.uniform(8, 20), dx = rng.uniform(-1, 1), dy = rng.uniform(-1, 1);
    for (int step = 0; step < 30; ++step, x += dx, y += dy) {
      const int column = static_cast<int>(x), row = static_cast<int>(y);
      if (row < frame || row > 26 - frame || column < frame || column > 26 - frame) break;
      for (int k = 0; k < 4; ++k)
        images[static_cast<std::size_t>(i * 784 + (row + k / 2) * 28 + column + k % 2)] =
            static_cast<std::uint8_t>(100 + rng.below(156));
    }
  }
  return images;
}

// As much to do as MNIST's digits for what skips the black: bows four pixels wide that light 19 % of the
// pixels, 22 % with what lies between the first and the last one of a row.
inline std::vector<std::uint8_t> digit_images(int n, Seed seed) {
  std::vector<std::uint8_t> images(static_cast<std::size_t>(n) * 784, 0);
  for (int i = 0; i < n; ++i) {
    Rng rng(seed.child(static_cast<std::uint64_t>(i)));
    float x = rng.uniform(8, 16), y = rng.uniform(3, 9), angle = rng.uniform(0, 3),
          turn = rng.uniform(0.05f, 0.2f);
    for (int step = 0; step < 44; ++step, angle += turn) {
      x = std::clamp(x + std::cos(angle), 4.f, 20.f);
      y = std::clamp(y + std::sin(angle), 4.f, 20.f);
      for (int k = 0; k < 16; ++k)
        images[static_cast<std::size_t>(i * 784 + (static_cast<int>(y) + k / 4) * 28 + static_cast<int>(x) +
                                        k % 4)] = static_cast<std::uint8_t>(100 + rng.below(156));
    }
  }
  return images;
}

inline std::vector<float> as_floats(const std::vector<std::uint8_t>& bytes) {
  std::vector<float> floats;
  for (std::uint8_t b : bytes) floats.push_back(static_cast<float>(b) * (1.f / 255.f));
  return floats;
}

}  // namespace hbr
