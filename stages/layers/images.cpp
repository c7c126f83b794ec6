#include "stages/layers/images.h"

#include "pipeline/drawing/draw.h"

namespace hbr::inline stages {

std::vector<std::uint8_t> draw_all(const LayerModel& model, const Elites& elites, Workers& workers) {
  const auto n = static_cast<std::size_t>(elites.size()), pixels = model.images() * std::size_t{kImagePixels};
  std::vector<std::uint8_t> bytes(n * pixels);
  workers.for_ranges(n, 16, [&](std::size_t begin, std::size_t end) {
    std::vector<float> images(pixels);
    for (std::size_t i = begin; i < end; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      model.draw(elites.solution.row(row).data(), elites.genes(row), images.data());
      for (int k = 0; k < model.images(); ++k)
        image_to_bytes(&images[k * kImagePixels], &bytes[i * pixels + k * kImagePixels]);
    }
  });
  return bytes;
}

void write_images(Hdf5Writer& file, const LayerModel& model, const Elites& elites, Workers& workers) {
  const std::vector<std::uint8_t> bytes = draw_all(model, elites, workers);
  std::vector<std::size_t> shape{static_cast<std::size_t>(elites.size())};
  if (model.images() > 1) shape.push_back(static_cast<std::size_t>(model.images()));
  shape.insert(shape.end(), {kImageSide, kImageSide});
  file.write("image", shape, bytes.data());
}

}  // namespace hbr::inline stages
