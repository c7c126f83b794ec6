// Executions described by the image that they draw: its place in a learned descriptor, and how well that
// knows such images.
#pragma once

#include "pipeline/hierarchy/coordinate.h"
#include "pipeline/hierarchy/descriptor.h"
#include "pipeline/hierarchy/drawing_settings.h"
#include "pipeline/hierarchy/outcome.h"

namespace hbr::inline hierarchy {

// Draws what an execution did from the time that it put its pen down for the k-th time until the next: image
// [28 x 28].
void draw_stroke(const Executions& executions, int execution, int k, const PencilSettings& pencil,
                 float* image);

// Has n images [n x 28 x 28] described: positions [n x dimension], and as fitness minus the errors [n].
void describe_images(const Descriptor& descriptor, Eigen::Index n, const float* images, float* position,
                     float* fitness);

// A place in a learned descriptor's space, whose range is the same in every dimension.
Coordinates latent_coordinates(int dimension, double low, double high);
Coordinates latent_coordinates(const Descriptor& descriptor);
// What the fitness of an image is.
FitnessMeaning image_fitness();

// Fitness: minus the error of reconstruction. What was not executed is described as an empty image, for
// nobody to read.
class ImageOutcome final : public Outcome {
 public:
  ImageOutcome(const Descriptor& descriptor, const PencilSettings& pencil, Way way)
      : descriptor_(descriptor), pencil_(pencil), way_(way) {}
  int descriptor_size() const override { return static_cast<int>(descriptor_.dimension()); }
  float low() const override { return descriptor_.lower().minCoeff(); }
  float high() const override { return descriptor_.upper().maxCoeff(); }
  Way way() const override { return way_; }
  void measure(const Executions& executions, float* descriptor, float* fitness) const override;

 private:
  const Descriptor& descriptor_;
  PencilSettings pencil_;
  Way way_;
};

}  // namespace hbr::inline hierarchy
