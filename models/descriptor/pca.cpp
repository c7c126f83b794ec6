#include "models/descriptor/pca.h"

#include <Eigen/Eigenvalues>

#include "models/descriptor/image_tile.h"
#include "pipeline/drawing/draw.h"

namespace hbr::inline descriptor {
namespace {

// The leading eigenvectors of the images' covariance, as rows.
Rows leading_directions(const Rows& images, const Rows& mean, int count) {
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(kImagePixels, kImagePixels);
  for (Eigen::Index begin = 0; begin < images.rows(); begin += kFittedTogether) {
    const Eigen::Index rows = std::min(kFittedTogether, images.rows() - begin);
    const Rows centred = images.middleRows(begin, rows).rowwise() - mean.row(0);
    covariance.selfadjointView<Eigen::Lower>().rankUpdate(centred.cast<double>().transpose());
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance);
  Rows directions(count, kImagePixels);
  for (int d = 0; d < count; ++d) {
    Eigen::VectorXd v = solver.eigenvectors().col(kImagePixels - 1 - d);
    Eigen::Index greatest;
    v.cwiseAbs().maxCoeff(&greatest);
    if (v[greatest] < 0) v = -v;
    directions.row(d) = v.cast<float>().transpose();
  }
  return directions;
}

}  // namespace

PrincipalComponents::PrincipalComponents(std::span<const std::uint8_t> bytes, int dimension)
    : ReconstructingDescriptor(dimension),
      placement_{Eigen::VectorXf::Ones(dimension), Eigen::VectorXf::Zero(dimension)} {
  const Rows images = as_images(bytes);
  mean_ = images.cast<double>().colwise().mean().cast<float>();
  basis_ = leading_directions(images, mean_, dimension);
  basis_of_pixels_ = basis_.transpose();
  Rows raw(images.rows(), dimension), decoded(images.rows(), kImagePixels);
  reconstruct(images.rows(), images.data(), raw.data(), decoded.data());
  placement_ = fill_unit_box(raw);
}

PrincipalComponents::PrincipalComponents(const Hdf5Reader& file)
    : ReconstructingDescriptor(read_dimension(file)),
      mean_(read_matrix(file, "pca/mean", 1, kImagePixels)),
      basis_(read_matrix(file, "pca/basis", dimension(), kImagePixels)),
      basis_of_pixels_(basis_.transpose()),
      placement_(read_placement(file, dimension())) {}

void PrincipalComponents::reconstruct(Eigen::Index n, const float* images, float* position,
                                      float* decoded) const {
  const Eigen::Index dim = dimension();
  for_image_tiles(n, images, [&](ImageTile& tile, Eigen::Index first) {
    for (Eigen::Index p = 0; p < kImagePixels; ++p) tile.pixels[p] -= mean_(0, p);
    net::Lanes place[net::kMaxLatent];
    multiply(dim, kImagePixels, basis_.data(), nullptr, tile.pixels, place);
    multiply(kImagePixels, dim, basis_of_pixels_.data(), mean_.data(), place, tile.pixels);
    store_lanes(tile, kImagePixels, tile.pixels, decoded + first * kImagePixels);
    for (Eigen::Index d = 0; d < dim; ++d) place[d] = place[d] * placement_.scale[d] + placement_.offset[d];
    store_lanes(tile, dim, place, position + first * dim);
  });
}

void PrincipalComponents::write(Hdf5Writer& file) const {
  file.attribute("kind", std::string("pca"));
  write_matrix(file, "pca/mean", mean_);
  write_matrix(file, "pca/basis", basis_);
  write_placement(file, placement_);
}

}  // namespace hbr::inline descriptor
