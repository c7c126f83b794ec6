// Small trainings.
#pragma once

#include <cstdint>
#include <vector>

#include "models/autoencoder/trainer.h"
#include "tests/models/autoencoder/images.h"

namespace hbr {

// Strokes with made-up labels.
struct Set {
  Set(int n, std::uint64_t seed) : pixels(stroke_images(n, Seed(seed))) {
    for (int i = 0; i < n; ++i) labels.push_back(static_cast<std::uint8_t>(i % 10));
  }
  ImageSet set() const { return {static_cast<std::int64_t>(labels.size()), pixels.data(), labels.data()}; }

  std::vector<std::uint8_t> pixels, labels;
};

// A training of a few such images, cut after the second epoch.
inline AutoencoderSettings small(int epochs) {
  AutoencoderSettings s;
  s.epochs = epochs;
  s.batch = 50;  // four shares: three of 16 images, one of 2
  s.halve_every = 2;
  s.cut_after = 2;
  return s;
}

}  // namespace hbr
