// The paper's autoencoder, trained: an image becomes a position in [-1, 1]^d and a reconstruction error.
// Immutable and thread-safe; what comes out for an image does not depend on the images beside it.
#pragma once

#include <cstddef>

#include "models/autoencoder/network.h"
#include "pipeline/hierarchy/descriptor.h"

namespace hbr::inline autoencoder {

class Autoencoder final : public Descriptor {
 public:
  explicit Autoencoder(net::Network network);

  const Eigen::VectorXf& lower() const override { return lower_; }
  const Eigen::VectorXf& upper() const override { return upper_; }
  // images [n x 784] in [0, 1]; latent [n x d]; error [n], mean squared error per pixel.
  void describe(Eigen::Index n, const float* images, float* latent, float* error) const override;
  // The two halves of it; decoded [n x 784] in (0, 1).
  void encode(Eigen::Index n, const float* images, float* latent) const;
  void decode(Eigen::Index n, const float* latent, float* decoded) const;

  // The same for images of bytes, where 255 is white, that lie anywhere: images [n] point to 784 bytes each.
  void describe(Eigen::Index n, const std::uint8_t* const* images, float* latent, float* error) const;

  const net::Network& network() const { return network_; }

 private:
  net::Network network_;
  Eigen::VectorXf lower_, upper_;
};

}  // namespace hbr::inline autoencoder
