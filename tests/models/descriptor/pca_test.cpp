// Principal components against closed forms and OpenCV's.
#include "models/descriptor/pca.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "pipeline/core/check.h"
#include "tests/models/autoencoder/images.h"
#include "tests/models/descriptor/contract.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

TEST(PrincipalComponents, PaintImagesOfTheirOwnRankAgain) {
  std::vector<std::uint8_t> bytes;
  Rng rng{Seed(1)};
  for (int i = 0; i < 50; ++i) {
    const auto upper = static_cast<std::uint8_t>(rng.below(256));
    const auto lower = static_cast<std::uint8_t>(rng.below(256));
    for (int p = 0; p < 784; ++p) bytes.push_back(p < 300 ? upper : p < 700 ? lower : 255);
  }
  const Rows images = as_images(bytes);
  for (const auto& [dimension, all] : {std::pair{1, false}, {2, true}, {3, true}}) {
    const PrincipalComponents pca(bytes, dimension);
    const Described d = describe(pca, images);
    EXPECT_EQ(*std::max_element(d.error.begin(), d.error.end()) < 1e-10f, all) << dimension;
  }
}

TEST(PrincipalComponents, AreOpenCvs) {
  constexpr int n = 90, dim = 3;
  const auto bytes = stroke_images(n, Seed(2));
  const Rows images = as_images(bytes);
  const PrincipalComponents pca(bytes, dim);
  const cv::Mat rows(n, 784, CV_32F, const_cast<float*>(images.data()));
  const cv::PCA other(rows, cv::noArray(), cv::PCA::DATA_AS_ROW, dim);
  for (int d = 0; d < dim; ++d) {
    const Eigen::Map<const Eigen::RowVectorXf> direction(other.eigenvectors.ptr<float>(d), 784);
    EXPECT_NEAR(std::abs(pca.basis().row(d).dot(direction)), 1, 1e-5) << d;
  }
  const cv::Mat decoded = other.backProject(other.project(rows));
  Rows position(n, dim), painted(n, 784);
  pca.reconstruct(n, images.data(), position.data(), painted.data());
  EXPECT_LT((painted - Eigen::Map<const Rows>(decoded.ptr<float>(), n, 784)).cwiseAbs().maxCoeff(), 1e-5);
  const Described described = describe(pca, images);
  for (int i = 0; i < n; ++i)
    EXPECT_NEAR(described.error[static_cast<std::size_t>(i)],
                (images.row(i) - painted.row(i)).squaredNorm() / 784, 1e-6);
}

// Finite, but the square of its distance from any image is not.
TEST(ReconstructingDescriptor, RefusesWhatIsFarFromAnImage) {
  struct Blinding final : ReconstructingDescriptor {
    Blinding() : ReconstructingDescriptor(2) {}
    void reconstruct(Eigen::Index n, const float*, float* position, float* decoded) const override {
      std::fill(position, position + 2 * n, 0.f);
      std::fill(decoded, decoded + 784 * n, 1e20f);
    }
    void write(Hdf5Writer&) const override {}
  };
  try {
    describe(Blinding(), Rows::Zero(1, 784));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("its error is inf; expected values about 0 to 1"));
  }
}

TEST(PrincipalComponents, FillTheUnitBox) {
  const auto bytes = stroke_images(60, Seed(3));
  const Rows images = as_images(bytes);
  const PrincipalComponents pca(bytes, 2);
  Rows position(60, 2), decoded(60, 784);
  pca.reconstruct(60, images.data(), position.data(), decoded.data());
  for (int d = 0; d < 2; ++d) {
    EXPECT_NEAR(position.col(d).minCoeff(), -1, 1e-5);
    EXPECT_NEAR(position.col(d).maxCoeff(), 1, 1e-5);
  }
  EXPECT_EQ(pca.lower(), Eigen::VectorXf::Constant(2, -1.f));
  EXPECT_EQ(pca.upper(), Eigen::VectorXf::Constant(2, 1.f));
  // Far beyond, an image is brought back.
  const Described far = describe(pca, Rows(10 * (images.row(0) - pca.mean()) + pca.mean()));
  for (const float z : far.position) EXPECT_LE(std::abs(z), 1);
}

TEST(PrincipalComponents, EveryImageStandsAlone) {
  const auto bytes = stroke_images(70, Seed(4));
  expect_images_stand_alone(PrincipalComponents(bytes, 2), as_images(bytes));
}

TEST(PrincipalComponents, ComeBackFromAFile) {
  const TemporaryFolder folder;
  const auto bytes = stroke_images(40, Seed(5));
  const PrincipalComponents pca(bytes, 3);
  const PrincipalComponents read = read_back(pca, folder.path() / "pca.h5");
  EXPECT_EQ(read.dimension(), 3);
  EXPECT_TRUE(describe(read, as_images(bytes)) == describe(pca, as_images(bytes)));
}

}  // namespace
}  // namespace hbr
