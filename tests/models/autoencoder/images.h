// Images for tests: soft random strokes on black, with a black frame of changing width.
#pragma once

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

inline std::vector<float> as_floats(const std::vector<std::uint8_t>& bytes) {
  std::vector<float> floats;
  for (std::uint8_t b : bytes) floats.push_back(static_cast<float>(b) * (1.f / 255.f));
  return floats;
}

}  // namespace hbr
