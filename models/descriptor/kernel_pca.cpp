#include "models/descriptor/kernel_pca.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "models/descriptor/image_tile.h"
#include "pipeline/core/check.h"
#include "pipeline/drawing/draw.h"

namespace hbr::inline descriptor {
namespace {

using net::Lanes;

// Of all rows of a with all rows of b.
Eigen::MatrixXd gaussian(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double gamma) {
  Eigen::MatrixXd distance = -2 * a * b.transpose();
  distance.colwise() += a.rowwise().squaredNorm();
  distance.rowwise() += b.rowwise().squaredNorm().transpose();
  return (-gamma * distance.array().max(0)).exp();
}

// Kernel values of a tile's images with every landmark.
void kernel_values(const ImageTile& tile, const Rows& landmarks, const Rows& squares, float gamma,
                   Lanes* values) {
  multiply(landmarks.rows(), kImagePixels, landmarks.data(), nullptr, tile.pixels, values);
  if (gamma == 0) return;
  Lanes square{};
  for (const Lanes& pixel : tile.pixels) square += pixel * pixel;
  for (Eigen::Index j = 0; j < landmarks.rows(); ++j) {
    const Lanes distance = square + squares(0, j) - 2.f * values[j];
    values[j] = net::exp(-gamma * (distance > 0.f ? distance : Lanes{}));
  }
}

}  // namespace

KernelPca::KernelPca(const KernelPcaSettings& settings, std::span<const std::uint8_t> bytes, int dimension)
    : ReconstructingDescriptor(dimension),
      gamma_(static_cast<float>(settings.gamma)),
      preimage_gamma_(static_cast<float>(settings.preimage_gamma)) {
  const Rows images = as_images(bytes);
  const Eigen::Index n = images.rows(), m = settings.landmarks;
  if (m > n) throw InputError("kernel PCA: landmarks = {}; expected at most the {} training images", m, n);
  landmarks_.resize(m, kImagePixels);
  for (Eigen::Index i = 0; i < m; ++i) landmarks_.row(i) = images.row(i * n / m);
  squares_ = landmarks_.rowwise().squaredNorm().transpose();
  fit_components(dimension);
  origin_ = Rows::Zero(1, dimension);

  const Placement placement = fill_unit_box(positions_of(images));
  components_ = placement.scale.asDiagonal() * components_;
  origin_ = placement.offset.transpose();
  centres_ = positions_of(landmarks_);
  fit_way_back(images, positions_of(images), settings.ridge);
}

// Eigenvectors of the kernel centred in feature space. They sum to zero, so that centring the kernel values
// of a new image would only shift its place; the placement takes up that and the eigenvalues' scale.
void KernelPca::fit_components(int dimension) {
  const Eigen::MatrixXd x = landmarks_.cast<double>();
  const Eigen::MatrixXd kernel = gamma_ == 0 ? Eigen::MatrixXd(x * x.transpose()) : gaussian(x, x, gamma_);
  const Eigen::VectorXd mean = kernel.rowwise().mean();
  Eigen::MatrixXd centred = kernel;
  centred.colwise() -= mean;
  centred.rowwise() -= mean.transpose();
  centred.array() += mean.mean();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(centred);
  const Eigen::VectorXd& values = solver.eigenvalues();
  components_.resize(dimension, x.rows());
  for (int d = 0; d < dimension; ++d) {
    const Eigen::Index at = x.rows() - 1 - d;
    if (at < 0 || !(values[at] > 1e-10 * values[x.rows() - 1]))
      throw InputError("kernel PCA: {} landmarks span {} components, expected {}; take more landmarks",
                       x.rows(), d, dimension);
    Eigen::VectorXd v = solver.eigenvectors().col(at);
    Eigen::Index greatest;
    v.cwiseAbs().maxCoeff(&greatest);
    if (v[greatest] < 0) v = -v;
    components_.row(d) = v.cast<float>().transpose();
  }
}

// With landmarks c of all positions x this solves (K_cx K_xc + ridge K_cc) w = K_cx (images - mean), which
// is kernel ridge regression where every image is a landmark.
void KernelPca::fit_way_back(const Rows& images, const Rows& positions, double ridge) {
  mean_ = images.cast<double>().colwise().mean().cast<float>();
  const Eigen::MatrixXd centres = centres_.cast<double>();
  const Eigen::Index m = centres.rows();
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(m, m), targets = Eigen::MatrixXd::Zero(m, kImagePixels);
  for (Eigen::Index begin = 0; begin < images.rows(); begin += kFittedTogether) {
    const Eigen::Index rows = std::min(kFittedTogether, images.rows() - begin);
    const Eigen::MatrixXd kernel =
        gaussian(centres, positions.middleRows(begin, rows).cast<double>(), preimage_gamma_);
    system.selfadjointView<Eigen::Lower>().rankUpdate(kernel);
    const Rows centred = images.middleRows(begin, rows).rowwise() - mean_.row(0);
    targets += kernel * centred.cast<double>();
  }
  system += ridge * gaussian(centres, centres, preimage_gamma_);
  // Landmarks that lie close together make it nearly singular.
  system.diagonal().array() += 1e-12 * system.trace();
  painter_ = system.selfadjointView<Eigen::Lower>().ldlt().solve(targets).transpose().cast<float>();
}

Rows KernelPca::positions_of(const Rows& images) const {
  Rows positions(images.rows(), dimension());
  const auto values = std::make_unique<Lanes[]>(static_cast<std::size_t>(landmarks_.rows()));
  for_image_tiles(images.rows(), images.data(), [&](ImageTile& tile, Eigen::Index first) {
    Lanes place[net::kMaxLatent];
    kernel_values(tile, landmarks_, squares_, gamma_, values.get());
    multiply(dimension(), landmarks_.rows(), components_.data(), origin_.data(), values.get(), place);
    store_lanes(tile, dimension(), place, positions.row(first).data());
  });
  return positions;
}

KernelPca::KernelPca(const Hdf5Reader& file)
    : ReconstructingDescriptor(read_dimension(file)),
      gamma_(static_cast<float>(file.number_attribute("gamma"))),
      preimage_gamma_(static_cast<float>(file.number_attribute("preimage_gamma"))),
      landmarks_(read_matrix(file, "kernel_pca/landmarks", -1, kImagePixels)),
      squares_(landmarks_.rowwise().squaredNorm().transpose()),
      components_(read_matrix(file, "kernel_pca/components", dimension(), landmarks_.rows())),
      origin_(read_matrix(file, "kernel_pca/origin", 1, dimension())),
      centres_(read_matrix(file, "kernel_pca/centres", landmarks_.rows(), dimension())),
      mean_(read_matrix(file, "kernel_pca/mean", 1, kImagePixels)),
      painter_(read_matrix(file, "kernel_pca/painter", kImagePixels, landmarks_.rows())) {}

void KernelPca::reconstruct(Eigen::Index n, const float* images, float* position, float* decoded) const {
  const Eigen::Index dim = dimension(), m = landmarks_.rows();
  const auto values = std::make_unique<Lanes[]>(static_cast<std::size_t>(m));
  for_image_tiles(n, images, [&](ImageTile& tile, Eigen::Index first) {
    Lanes place[net::kMaxLatent];
    kernel_values(tile, landmarks_, squares_, gamma_, values.get());
    multiply(dim, m, components_.data(), origin_.data(), values.get(), place);
    store_lanes(tile, dim, place, position + first * dim);
    for (Eigen::Index j = 0; j < m; ++j) {
      Lanes distance{};
      for (Eigen::Index d = 0; d < dim; ++d) {
        const Lanes gap = place[d] - centres_(j, d);
        distance += gap * gap;
      }
      values[static_cast<std::size_t>(j)] = net::exp(-preimage_gamma_ * distance);
    }
    multiply(kImagePixels, m, painter_.data(), mean_.data(), values.get(), tile.pixels);
    store_lanes(tile, kImagePixels, tile.pixels, decoded + first * kImagePixels);
  });
}

void KernelPca::write(Hdf5Writer& file) const {
  file.attribute("kind", std::string("kernel_pca"));
  file.attribute("dimension", static_cast<std::int64_t>(dimension()));
  file.attribute("gamma", static_cast<double>(gamma_));
  file.attribute("preimage_gamma", static_cast<double>(preimage_gamma_));
  write_matrix(file, "kernel_pca/landmarks", landmarks_);
  write_matrix(file, "kernel_pca/components", components_);
  write_matrix(file, "kernel_pca/origin", origin_);
  write_matrix(file, "kernel_pca/centres", centres_);
  write_matrix(file, "kernel_pca/mean", mean_);
  write_matrix(file, "kernel_pca/painter", painter_);
}

}  // namespace hbr::inline descriptor
