// The images of a repertoire of digits, kept beside its elites.
#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/drawing/draw.h"
#include "pipeline/qd/elites.h"

namespace hbr {

// Writes `image` [n x 28 x 28], drawn by draw_row(genome, length, image).
template <class DrawRow>
void write_images(Hdf5Writer& file, const Elites& elites, DrawRow&& draw_row) {
  std::vector<float> image(kImagePixels);
  std::vector<std::uint8_t> bytes(elites.size() * kImagePixels);
  for (Eigen::Index i = 0; i < elites.size(); ++i) {
    draw_row(elites.solution.row(i).data(), elites.genes(i), image.data());
    image_to_bytes(image.data(), &bytes[i * kImagePixels]);
  }
  file.write("image", {static_cast<std::size_t>(elites.size()), kImageSide, kImageSide}, bytes.data());
}

}  // namespace hbr
