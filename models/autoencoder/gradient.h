// One share of a batch's gradient, with the room to work it out. A batch is always divided into the same
// number of slots and these are summed in their order, so the threads that fill them leave no trace.
#pragma once

#include <cstdint>
#include <memory>

#include "models/autoencoder/network.h"

namespace hbr::net {

class GradientSlot {
 public:
  explicit GradientSlot(const Layout& layout);
  ~GradientSlot();
  GradientSlot(GradientSlot&&) noexcept;

  // Adds d(scale * sum of the errors of n images)/d(parameters); images [n] point to 784 bytes each. Returns
  // the sum of the errors.
  double add(const Network& network, int n, const std::uint8_t* const* images, float scale);

  // One number per parameter, then those of the sub-pixel kernels, see fold_subpixel.
  Floats& gradient() { return gradient_; }

 private:
  struct Room;
  Floats gradient_;
  std::unique_ptr<Room> room_;
};

// Brings the sub-pixel part of a gradient home into the parameters' part.
void fold_subpixel(const Layout& layout, float* gradient);

}  // namespace hbr::net
