// Kernel principal components against their textbook formulas, in double precision.
#include "models/descriptor/kernel_pca.h"

#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <cmath>

#include "models/descriptor/pca.h"
#include "pipeline/core/check.h"
#include "tests/models/autoencoder/images.h"
#include "tests/models/descriptor/contract.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

using Eigen::MatrixXd;

KernelPcaSettings settings(int landmarks, double gamma) { return {landmarks, gamma, 3, 0.01}; }

struct Painted {
  Painted(const ReconstructingDescriptor& descriptor, const Rows& images)
      : position(images.rows(), descriptor.dimension()), decoded(images.rows(), 784) {
    descriptor.reconstruct(images.rows(), images.data(), position.data(), decoded.data());
  }
  Rows position, decoded;
};

MatrixXd gaussian(const MatrixXd& a, const MatrixXd& b, double gamma) {
  MatrixXd k(a.rows(), b.rows());
  for (Eigen::Index i = 0; i < a.rows(); ++i)
    for (Eigen::Index j = 0; j < b.rows(); ++j)
      k(i, j) = std::exp(-gamma * (a.row(i) - b.row(j)).squaredNorm());
  return k;
}

// Directions are known but for their sign.
void expect_same_but_for_sign(const Rows& found, const MatrixXd& expected) {
  for (Eigen::Index d = 0; d < found.cols(); ++d) {
    const Eigen::VectorXd column = found.col(d).cast<double>();
    const double same = (column - expected.col(d)).cwiseAbs().maxCoeff();
    const double turned = (column + expected.col(d)).cwiseAbs().maxCoeff();
    EXPECT_LT(std::min(same, turned), 1e-4) << d;
  }
}

TEST(KernelPca, WithALinearKernelIsPca) {
  const auto bytes = stroke_images(80, Seed(1));
  const Rows others = as_images(stroke_images(30, Seed(2)));
  const PrincipalComponents pca(bytes, 2);
  const KernelPca kernel_pca(settings(80, 0), bytes, 2);
  expect_same_but_for_sign(Painted(kernel_pca, others).position,
                           Painted(pca, others).position.cast<double>());
}

// As scikit-learn has it: eigenvectors of the doubly centred kernel over the root of their eigenvalue,
// applied to the kernel values of new images, centred by those of the landmarks.
TEST(KernelPca, PositionsAreTheTextbooks) {
  constexpr int n = 60, m = 30;
  constexpr double gamma = 0.03;
  const auto bytes = stroke_images(n, Seed(3));
  const MatrixXd images = as_images(bytes).cast<double>();
  MatrixXd landmarks(m, 784);
  for (int i = 0; i < m; ++i) landmarks.row(i) = images.row(i * n / m);
  const MatrixXd k = gaussian(landmarks, landmarks, gamma), ones = MatrixXd::Constant(m, m, 1. / m);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(k - ones * k - k * ones + ones * k * ones);
  const MatrixXd kn = gaussian(images, landmarks, gamma), ones_n = MatrixXd::Constant(n, m, 1. / m);
  const MatrixXd centred = kn - ones_n * k - kn * ones + ones_n * k * ones;
  MatrixXd expected(n, 2);
  for (int d = 0; d < 2; ++d) {
    const Eigen::VectorXd place =
        centred * solver.eigenvectors().col(m - 1 - d) / std::sqrt(solver.eigenvalues()[m - 1 - d]);
    const double low = place.minCoeff(), high = place.maxCoeff();  // to -1 and 1
    expected.col(d) = (2 * (place.array() - low) / (high - low) - 1).matrix();
  }
  expect_same_but_for_sign(Painted(KernelPca(settings(m, gamma), bytes, 2), as_images(bytes)).position,
                           expected);
}

// scikit-learn's inverse_transform: with K the kernel of the positions, image = k (K + ridge)^-1 images.
TEST(KernelPca, TheWayBackIsKernelRidgeRegression) {
  constexpr int n = 40;
  const auto bytes = stroke_images(n, Seed(4));
  const KernelPcaSettings s = settings(n, 0.03);
  const Painted painted(KernelPca(s, bytes, 2), as_images(bytes));
  const MatrixXd images = as_images(bytes).cast<double>(), places = painted.position.cast<double>();
  const Eigen::RowVectorXd mean = images.colwise().mean();
  const MatrixXd k = gaussian(places, places, s.preimage_gamma), centred = images.rowwise() - mean;
  MatrixXd expected = k * (k + s.ridge * MatrixXd::Identity(n, n)).ldlt().solve(centred);
  expected.rowwise() += mean;
  EXPECT_LT((painted.decoded.cast<double>() - expected).cwiseAbs().maxCoeff(), 1e-3);
  // It learned something: nearer to the images than their mean.
  EXPECT_LT((expected - images).squaredNorm(), 0.8 * centred.squaredNorm());
}

TEST(KernelPca, EveryImageStandsAlone) {
  const auto bytes = stroke_images(70, Seed(5));
  expect_images_stand_alone(KernelPca(settings(33, 0.02), bytes, 2), as_images(bytes));
}

TEST(KernelPca, ComesBackFromAFile) {
  const TemporaryFolder folder;
  const auto bytes = stroke_images(40, Seed(6));
  const KernelPca made(settings(20, 0.02), bytes, 3);
  const KernelPca read = read_back(made, folder.path() / "kernel_pca.h5");
  EXPECT_TRUE(describe(read, as_images(bytes)) == describe(made, as_images(bytes)));
}

TEST(KernelPca, SaysWhatIsWrong) {
  const auto bytes = stroke_images(10, Seed(7));
  const auto complaint = [&](int landmarks, int dimension) {
    try {
      KernelPca(settings(landmarks, 0.02), bytes, dimension);
      return std::string("accepted");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
  };
  EXPECT_THAT(complaint(11, 2), testing::HasSubstr("landmarks = 11; expected at most the 10"));
  EXPECT_THAT(complaint(2, 2), testing::HasSubstr("2 landmarks span 1 components, expected 2"));
}

}  // namespace
}  // namespace hbr
