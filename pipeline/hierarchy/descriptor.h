// A learned descriptor: maps an image to a place in a low-dimensional space and tells how well it knows such
// images. The autoencoder is one; principal components of images (models/descriptor) and imported networks
// (models/onnx) are others.
#pragma once

#include <Eigen/Core>

namespace hbr::inline hierarchy {

class Descriptor {
 public:
  virtual ~Descriptor() = default;
  // Range of the position [dim]; the number of dimensions is their size.
  virtual const Eigen::VectorXf& lower() const = 0;
  virtual const Eigen::VectorXf& upper() const = 0;
  // images [n x 784]: 28 x 28, row-major, white strokes (1) on black (0). Writes position [n x dim] and error
  // [n], the mean squared error per pixel between the image and its reconstruction. What is written for an
  // image depends on that image alone. Thread-safe.
  virtual void describe(Eigen::Index n, const float* images, float* position, float* error) const = 0;

  Eigen::Index dimension() const { return lower().size(); }
};

}  // namespace hbr::inline hierarchy
