#include "models/autoencoder/autoencoder.h"

#include <algorithm>
#include <utility>

#include "models/autoencoder/forward.h"

namespace hbr::inline autoencoder {
namespace {

using net::Index;
using net::kLanes;
using net::kPixels;
using net::kPlanes;
using net::kTileImages;
using net::Tile;

// body(tile, first image, images) for n images.
template <class Body>
void for_tiles(Index n, Body&& body) {
  const auto tile = std::make_unique<Tile>();
  for (Index i = 0; i < n; i += kTileImages)
    body(*tile, i, static_cast<int>(std::min<Index>(n - i, kTileImages)));
}

// Lane `image` of row `row` of the first plane's map, across planes.
float lane_of(const net::Lanes* map, Index row, int image) {
  return map[image / kLanes * net::kPlane + row][image % kLanes];
}

template <class Pixel>
void load(Tile& tile, const Pixel* const* images, int count) {
  net::load_images(tile, count, images);
}

void load(Tile& tile, const float* images, int count) {
  const float* rows[kTileImages];
  for (int i = 0; i < count; ++i) rows[i] = images + i * kPixels;
  net::load_images(tile, count, rows);
}

void read_latent(const Tile& tile, int count, Index dim, float* latent) {
  for (int i = 0; i < count; ++i)
    for (Index d = 0; d < dim; ++d) latent[i * dim + d] = lane_of(tile.map(net::kPosition), d, i);
}

template <class Images>
void describe_all(const net::Network& network, Index n, Images images_of, float* latent, float* error) {
  const Index dim = network.layout.latent_size;
  for_tiles(n, [&](Tile& tile, Index first, int count) {
    load(tile, images_of(first), count);
    net::encode(network, tile, false);
    net::decode(network, tile);
    read_latent(tile, count, dim, latent + first * dim);
    for (int v = 0; v < kPlanes; ++v) {
      const net::Lanes e = net::reconstruction_error(tile, v);
      for (int i = v * kLanes; i < std::min(count, (v + 1) * kLanes); ++i) error[first + i] = e[i % kLanes];
    }
  });
}

}  // namespace

Autoencoder::Autoencoder(net::Network network)
    : network_(std::move(network)),
      lower_(Eigen::VectorXf::Constant(network_.layout.latent_size, -1.f)),
      upper_(Eigen::VectorXf::Constant(network_.layout.latent_size, 1.f)) {}

void Autoencoder::describe(Eigen::Index n, const float* images, float* latent, float* error) const {
  describe_all(
      network_, n, [&](Index first) { return images + first * kPixels; }, latent, error);
}

void Autoencoder::describe(Eigen::Index n, const std::uint8_t* const* images, float* latent,
                           float* error) const {
  describe_all(
      network_, n, [&](Index first) { return images + first; }, latent, error);
}

void Autoencoder::encode(Eigen::Index n, const float* images, float* latent) const {
  for_tiles(n, [&](Tile& tile, Index first, int count) {
    load(tile, images + first * kPixels, count);
    net::encode(network_, tile, false);
    read_latent(tile, count, dimension(), latent + first * dimension());
  });
}

void Autoencoder::decode(Eigen::Index n, const float* latent, float* decoded) const {
  for_tiles(n, [&](Tile& tile, Index first, int count) {
    for (int i = 0; i < count; ++i)
      for (Index d = 0; d < dimension(); ++d)
        tile.map(net::kPosition)[i / kLanes * net::kPlane + d][i % kLanes] =
            latent[(first + i) * dimension() + d];
    net::decode(network_, tile);
    for (int i = 0; i < count; ++i)
      for (Index p = 0; p < kPixels; ++p)
        decoded[(first + i) * kPixels + p] = lane_of(tile.map(net::kDecoded), p, i);
  });
}

}  // namespace hbr::inline autoencoder
