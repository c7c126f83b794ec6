// Principal components of images: the position is the projection on the d directions of the greatest
// variance, the reconstruction the nearest image in their span.
#pragma once

#include <cstdint>
#include <span>

#include "models/descriptor/reconstructing_descriptor.h"

namespace hbr::inline descriptor {

class PrincipalComponents final : public ReconstructingDescriptor {
 public:
  // Fits to images of 784 bytes; their projections fill [-1, 1]^d. A direction points to where its greatest
  // entry is positive.
  PrincipalComponents(std::span<const std::uint8_t> images, int dimension);
  explicit PrincipalComponents(const Hdf5Reader& file);

  void reconstruct(Eigen::Index n, const float* images, float* position, float* decoded) const override;
  void write(Hdf5Writer& file) const override;

  const Rows& mean() const { return mean_; }    // [1 x 784]
  const Rows& basis() const { return basis_; }  // [d x 784], orthonormal rows, by descending variance

 private:
  Rows mean_, basis_, basis_of_pixels_;  // the last one transposed
  Placement placement_;
};

}  // namespace hbr::inline descriptor
