#include "models/autoencoder/gradient.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <array>

#include "models/autoencoder/backward.h"

namespace hbr::net {
namespace {

// Tiles that are worked out side by side. With vectors of 16 lanes a group is 128 images.
constexpr int kGroupTiles = 8;

// body(begin, end) for the numbers of a gradient that backward() adds to: all but those of the dense layers.
template <class Body>
void for_convolutions(const Layout& layout, Body&& body) {
  body(Index{0}, layout.layers[kDense1].kernel);
  body(layout.layers[kDeconv1].kernel, gradient_size(layout));
}

// Brings the sub-pixel part of a gradient home into the parameters' part.
void fold_subpixel(const Layout& layout, float* gradient) {
  const float* spectra = gradient + layout.size;
  Floats deconv2(kSubpixelDeconv2, 0.f);
  deconv2_from_spectra(spectra, deconv2.data());
  from_subpixel(9, kMaps, kMaps, deconv2.data(), gradient + layout.layers[kDeconv2].kernel);
  from_subpixel(3, kMaps, 1, spectra + kDeconv2Spectra, gradient + layout.layers[kOutput].kernel);
}

}  // namespace

struct BatchGradient::Parts {
  // What a thread works in; nothing of it is kept.
  struct Room {
    Tile tile;
    Slopes slopes;
  };

  std::array<Floats, kGroupTiles> gradients;  // of the convolutions, a tile of each group
  std::vector<DenseRecord, tbb::cache_aligned_allocator<DenseRecord>> records;
  tbb::enumerable_thread_specific<std::unique_ptr<Room>> rooms{[] { return std::make_unique<Room>(); }};
};

BatchGradient::BatchGradient(const Layout& layout)
    : gradient_(static_cast<std::size_t>(gradient_size(layout))), parts_(std::make_unique<Parts>()) {
  parts_->gradients.fill(Floats(gradient_.size()));
  parts_->records.resize(kGroupTiles);
}
BatchGradient::~BatchGradient() = default;

double BatchGradient::find(const Network& network, int n, const std::uint8_t* const* images, float scale,
                           Workers& workers) {
  const Layout& layout = network.layout;
  auto& gradients = parts_->gradients;
  auto& records = parts_->records;
  std::fill(gradient_.begin(), gradient_.end(), 0.f);
  const auto tiles_from = [n](int first) {
    return static_cast<std::size_t>(std::min(kGroupTiles, (n - first + kTileImages - 1) / kTileImages));
  };
  double error = 0;
  for (int begin = 0; begin < n; begin += kGroupTiles * kTileImages) {
    std::array<double, kGroupTiles> errors{};
    const std::size_t tiles = tiles_from(begin);
    workers.for_each(tiles, [&](std::size_t t) {
      float* const gradient = gradients[t].data();
      if (begin == 0)
        for_convolutions(layout,
                         [&](Index first, Index last) { std::fill(gradient + first, gradient + last, 0.f); });
      const int first = begin + static_cast<int>(t) * kTileImages, count = std::min(n - first, kTileImages);
      auto& [tile, slopes] = *parts_->rooms.local();
      load_images(tile, count, images + first);
      encode(network, tile, true);
      decode(network, tile);
      backward(network, tile, slopes, scale, records[t], gradient);
      for (int i = 0; i < count; i += kLanes) {
        const Lanes e = reconstruction_error(tile, i / kLanes);
        for (int l = 0; l < std::min(kLanes, count - i); ++l) errors[t] += e[l];
      }
    });
    const std::span<const DenseRecord> used(records.data(), tiles);
    workers.for_ranges(kDenseInputs, kDenseInputs / kGroupTiles, [&](std::size_t first, std::size_t last) {
      add_dense_gradients(layout, used, static_cast<Index>(first), static_cast<Index>(last),
                          gradient_.data());
    });
    add_dense_biases(layout, used, gradient_.data());
    for (double e : errors) error += e;
  }
  for (std::size_t t = 0; t < tiles_from(0); ++t)
    for_convolutions(layout, [&](Index first, Index last) {
      for (Index i = first; i < last; ++i)
        gradient_[static_cast<std::size_t>(i)] += gradients[t][static_cast<std::size_t>(i)];
    });
  fold_subpixel(layout, gradient_.data());
  return error;
}

}  // namespace hbr::net
