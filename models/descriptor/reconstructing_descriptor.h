// What descriptors other than the paper's autoencoder share: they place an image in [-1, 1]^d and are judged
// by how they paint it again.
#pragma once

#include <cstdint>
#include <span>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/hierarchy/descriptor.h"
#include "pipeline/qd/elites.h"

namespace hbr::inline descriptor {

class ReconstructingDescriptor : public Descriptor {
 public:
  explicit ReconstructingDescriptor(Eigen::Index dimension);

  const Eigen::VectorXf& lower() const override { return lower_; }
  const Eigen::VectorXf& upper() const override { return upper_; }
  // What lies outside [-1, 1]^d comes back to its border, coordinate by coordinate.
  void describe(Eigen::Index n, const float* images, float* position, float* error) const final;

  // images [n x 784] in [0, 1]; position [n x d], which may leave [-1, 1]^d; decoded [n x 784]. What is
  // written for an image depends on that image alone. Thread-safe.
  virtual void reconstruct(Eigen::Index n, const float* images, float* position, float* decoded) const = 0;

  // Everything it takes to make it again, see pipeline/artifact/FORMAT.md.
  virtual void write(Hdf5Writer& file) const = 0;

 private:
  Eigen::VectorXf lower_, upper_;
};

// Of each coordinate: position = raw * scale + offset.
struct Placement {
  Eigen::VectorXf scale, offset;  // [d]
};
// Brings raw coordinates [n x d] onto [-1, 1], least and greatest onto its ends. A coordinate that is the
// same for all becomes 0.
Placement fill_unit_box(const Rows& raw);

// Bytes, where 255 is white, as images in [0, 1].
Rows as_images(std::span<const std::uint8_t> bytes);

// Matrices in files. Reading throws InputError, naming file and array, where the shape is another (-1: any)
// or a number is not finite.
void write_matrix(Hdf5Writer& file, const std::string& name, const Rows& matrix);
Rows read_matrix(const Hdf5Reader& file, const std::string& name, Eigen::Index rows, Eigen::Index columns);
void write_placement(Hdf5Writer& file, const Placement& placement);
Placement read_placement(const Hdf5Reader& file, Eigen::Index dimension);
// Attribute `dimension`, 1 to 8.
Eigen::Index read_dimension(const Hdf5Reader& file);

}  // namespace hbr::inline descriptor
