#include "pipeline/hierarchy/layers/image_outcome.h"

namespace hbr::inline hierarchy {

void draw_stroke(const Executions& executions, int execution, int k, const PencilSettings& pencil,
                 float* image) {
  thread_local std::vector<float> pen;
  pen.clear();
  const std::vector<PenDown>& down = executions.pen_down(execution);
  for (const std::int32_t elite : executions.stroke(execution, k)) {
    const Eigen::Vector2f p = executions.points().position(elite).cast<float>();
    pen.insert(pen.end(), {p.x(), p.y()});
  }
  draw(pen.data(), static_cast<Eigen::Index>(pen.size() / 2), pencil.width(down[k].width),
       framing_named(pencil.framing), executions.points().frame().half_side, image);
}

void describe_images(const Descriptor& descriptor, Eigen::Index n, const float* images, float* position,
                     float* fitness) {
  descriptor.describe(n, images, position, fitness);
  Eigen::Map<Eigen::VectorXf>(fitness, n) *= -1;
}

Coordinates latent_coordinates(int dimension, double low, double high) {
  Coordinates latent;
  for (int d = 1; d <= dimension; ++d) latent.push_back({"latent " + std::to_string(d), "", low, high});
  return latent;
}

Coordinates latent_coordinates(const Descriptor& descriptor) {
  return latent_coordinates(static_cast<int>(descriptor.dimension()), descriptor.lower().minCoeff(),
                            descriptor.upper().maxCoeff());
}

FitnessMeaning image_fitness() {
  return {"minus the mean squared error per pixel between the image and its reconstruction", ""};
}

void ImageOutcome::measure(const Executions& executions, float* descriptor, float* fitness) const {
  std::vector<float> images(static_cast<std::size_t>(executions.size()) * kImagePixels);
  for (int e = 0; e < executions.size(); ++e)
    if (!executions.way(e).empty()) draw_stroke(executions, e, 0, pencil_, &images[e * kImagePixels]);
  describe_images(descriptor_, executions.size(), images.data(), descriptor, fitness);
}

}  // namespace hbr::inline hierarchy
