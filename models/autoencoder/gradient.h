// The gradient of a batch. A batch is always divided in the same way and put together in the same order, so
// the threads that share the work leave no trace.
#pragma once

#include <cstdint>
#include <memory>

#include "models/autoencoder/network.h"
#include "pipeline/core/parallel.h"

namespace hbr::net {

class BatchGradient {
 public:
  explicit BatchGradient(const Layout& layout);
  ~BatchGradient();

  // d(scale * sum of the errors of n images)/d(parameters), in the place of the one before; images [n] point
  // to 784 bytes each. Returns the sum of the errors. As many threads help as there are tiles in a group
  // (gradient.cpp).
  double find(const Network& network, int n, const std::uint8_t* const* images, float scale,
              Workers& workers);

  // One number per parameter.
  const float* gradient() const { return gradient_.data(); }

 private:
  struct Parts;

  Floats gradient_;
  std::unique_ptr<Parts> parts_;
};

}  // namespace hbr::net
