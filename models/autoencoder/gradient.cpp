#include "models/autoencoder/gradient.h"

#include "models/autoencoder/backward.h"

namespace hbr::net {

struct GradientSlot::Room {
  Tile<2> tile;
  Slopes<2> slopes;
};

GradientSlot::GradientSlot(const Layout& layout)
    : gradient_(static_cast<std::size_t>(layout.size + kDeconv2Spectra + kSubpixelOutput), 0.f),
      room_(std::make_unique<Room>()) {}
GradientSlot::~GradientSlot() = default;
GradientSlot::GradientSlot(GradientSlot&&) noexcept = default;

double GradientSlot::add(const Network& network, int n, const std::uint8_t* const* images, float scale) {
  double error = 0;
  for (int first = 0; first < n; first += 2 * kLanes) {
    const int count = std::min(n - first, 2 * kLanes);
    load_images(room_->tile, count, images + first);
    encode(network, room_->tile, true);
    decode(network, room_->tile);
    backward(network, room_->tile, room_->slopes, scale, gradient_.data());
    for (int i = 0; i < count; i += kLanes) {
      const Lanes e = reconstruction_error(room_->tile, i / kLanes);
      for (int l = 0; l < std::min(kLanes, count - i); ++l) error += e[l];
    }
  }
  return error;
}

void fold_subpixel(const Layout& layout, float* gradient) {
  const float* spectra = gradient + layout.size;
  Floats deconv2(kSubpixelDeconv2, 0.f);
  deconv2_from_spectra(spectra, deconv2.data());
  from_subpixel(9, kMaps, kMaps, deconv2.data(), gradient + layout.layers[kDeconv2].kernel);
  from_subpixel(3, kMaps, 1, spectra + kDeconv2Spectra, gradient + layout.layers[kOutput].kernel);
}

}  // namespace hbr::net
