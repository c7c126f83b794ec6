#include "pipeline/drawing/image_difference.h"

#include <cstdlib>

#include "pipeline/drawing/draw.h"

namespace hbr::inline drawing {

ImageDifference image_difference(const Eigen::VectorXf& a, const Eigen::VectorXf& b) {
  return {(a - b).cwiseAbs().mean(), (a - b).squaredNorm() / static_cast<float>(kImagePixels)};
}

float image_difference(const std::uint8_t* a, const std::uint8_t* b) {
  int sum = 0;
  for (int p = 0; p < kImagePixels; ++p) sum += std::abs(a[p] - b[p]);
  return static_cast<float>(sum) / (255.0f * kImagePixels);
}

}  // namespace hbr::inline drawing
