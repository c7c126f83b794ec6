#include "pipeline/drawing/image_difference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "pipeline/core/random.h"
#include "pipeline/drawing/draw.h"

namespace hbr {
namespace {

TEST(ImageDifference, IsTheMeanOfAPlainLoop) {
  Rng rng(Seed(1));
  Eigen::VectorXf a(kImagePixels), b(kImagePixels);
  for (int p = 0; p < kImagePixels; ++p) a[p] = rng.uniform(0, 1), b[p] = rng.uniform(0, 1);
  double absolute = 0, squared = 0;
  for (int p = 0; p < kImagePixels; ++p) {
    const double difference = static_cast<double>(a[p]) - static_cast<double>(b[p]);
    absolute += std::abs(difference) / kImagePixels;
    squared += difference * difference / kImagePixels;
  }
  const ImageDifference found = image_difference(a, b);
  EXPECT_NEAR(found.absolute, absolute, 1e-6);
  EXPECT_NEAR(found.squared, squared, 1e-6);

  // In steps of 1/255 it is the same, but for their rounding.
  std::vector<std::uint8_t> a_bytes(kImagePixels), b_bytes(kImagePixels);
  image_to_bytes(a.data(), a_bytes.data());
  image_to_bytes(b.data(), b_bytes.data());
  EXPECT_NEAR(image_difference(a_bytes.data(), b_bytes.data()), absolute, 1.0 / 255);
  EXPECT_EQ(image_difference(a_bytes.data(), a_bytes.data()), 0);
  const std::vector<std::uint8_t> white(kImagePixels, 255), black(kImagePixels, 0);
  EXPECT_FLOAT_EQ(image_difference(white.data(), black.data()), 1);
}

}  // namespace
}  // namespace hbr
