// What the report shows of a learned descriptor: where the test images lie, and what becomes of a few.
#pragma once

#include <cstdint>
#include <vector>

#include "models/dataset/dataset.h"
#include "pipeline/artifact/hdf5_file.h"

namespace hbr::inline stages {

inline std::vector<float> as_floats(const std::vector<std::uint8_t>& bytes) {
  std::vector<float> floats;
  floats.reserve(bytes.size());
  for (const std::uint8_t b : bytes) floats.push_back(static_cast<float>(b) / 255.f);
  return floats;
}

inline void write_latent(Hdf5Writer& file, const LabelledImages& test, const std::vector<float>& position) {
  file.write("latent/position", {test.size(), position.size() / test.size()}, position.data());
  file.write("latent/label", test.labels);
}

// The first two test images of each class, and paint(their number, images, decoded) of them.
template <class Paint>
void write_examples(Hdf5Writer& file, const LabelledImages& test, Paint&& paint) {
  std::vector<std::uint8_t> original;
  for (int label = 0; label < kClasses; ++label)
    for (std::size_t i = 0, found = 0; i < test.size() && found < 2; ++i)
      if (test.labels[i] == label) {
        original.insert(original.end(), test.image(i), test.image(i) + kImagePixels);
        ++found;
      }
  const std::size_t n = original.size() / kImagePixels;
  const std::vector<float> images = as_floats(original);
  std::vector<float> decoded(images.size());
  paint(static_cast<Eigen::Index>(n), images.data(), decoded.data());
  file.write("reconstruction/original", {n, kImageSide, kImageSide}, original.data());
  file.write("reconstruction/decoded", {n, kImageSide, kImageSide}, decoded.data());
}

}  // namespace hbr::inline stages
