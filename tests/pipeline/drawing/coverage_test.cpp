// Ink against brute-force coverage and against OpenCV's lines.
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "tests/pipeline/drawing/images.h"

namespace hbr {
namespace {

double distance_to_segment(double x, double y, const double* ends) {
  const double ex = ends[2] - ends[0], ey = ends[3] - ends[1], l2 = ex * ex + ey * ey;
  const double t = l2 > 0 ? std::clamp(((x - ends[0]) * ex + (y - ends[1]) * ey) / l2, 0.0, 1.0) : 0;
  return std::hypot(x - ends[0] - t * ex, y - ends[1] - t * ey);
}

// Share of 24 x 24 points of each pixel that lie within half a width of the path, given in pixels.
Image brute_force(const std::vector<double>& px, double width) {
  constexpr int kSub = 24;
  Image image(kImagePixels);
  for (int row = 0; row < 28; ++row)
    for (int column = 0; column < 28; ++column) {
      std::vector<const double*> near;  // the segments that reach into the pixel
      for (std::size_t i = 0; i + 3 < px.size(); i += 2)
        if (distance_to_segment(column + 0.5, row + 0.5, &px[i]) <= width / 2 + 0.75) near.push_back(&px[i]);
      int inside = 0;
      for (int s = 0; s < kSub * kSub; ++s) {
        const double x = column + (s % kSub + 0.5) / kSub, y = row + (s / kSub + 0.5) / kSub;
        inside += std::ranges::any_of(
            near, [&](const double* ends) { return distance_to_segment(x, y, ends) <= width / 2; });
      }
      image[row * 28 + column] = static_cast<float>(inside) / (kSub * kSub);
    }
  return image;
}

std::vector<double> workspace_pixels(const Xy& path) {
  std::vector<double> px;
  for (std::size_t i = 0; i < path.size(); i += 2) {
    px.push_back((path[i] + kHalfSide) * kPixelsPerMetre);
    px.push_back((kHalfSide - path[i + 1]) * kPixelsPerMetre);
  }
  return px;
}

TEST(Coverage, WorkspaceAgreesWithBruteForceCoverage) {
  double mean = 0;
  int images = 0;
  for (const int points : {2, 6, 20, 80})
    for (const double width : {1.0, 1.37, 2.5, 4.0}) {
      const Xy path = wander(static_cast<std::uint64_t>(points), points);
      const Image image = drawn(path, width), exact = brute_force(workspace_pixels(path), width);
      EXPECT_LT(largest_difference(image, exact), 0.12) << points << " points, width " << width;
      EXPECT_NEAR(ink(image), ink(exact), 0.01 * ink(exact)) << points << " points, width " << width;
      mean += mean_difference(image, exact);
      ++images;
    }
  for (const double shift : {-0.4, 0.4}) {  // partly outside
    const Xy path = mapped(wander(5, 20), 1, shift, shift);
    EXPECT_LT(largest_difference(drawn(path, 2), brute_force(workspace_pixels(path), 2)), 0.12) << shift;
  }
  EXPECT_LT(mean / images, 0.001);
}

// OpenCV's polylines on a canvas of 16 x 16 sub-pixels a pixel, which knows whole widths and rounds its caps.
TEST(Coverage, WorkspaceAgreesWithOpenCv) {
  cv::setNumThreads(0);
  for (const int points : {2, 6, 20, 80})
    for (const double width : {1.0, 2.5, 4.0}) {
      const Xy path = wander(static_cast<std::uint64_t>(points) + 100, points);
      std::vector<cv::Point> polyline;
      const std::vector<double> px = workspace_pixels(path);
      for (std::size_t i = 0; i < px.size(); i += 2)
        polyline.emplace_back(static_cast<int>(std::lround((px[i] * 16 - 0.5) * 256)),
                              static_cast<int>(std::lround((px[i + 1] * 16 - 0.5) * 256)));
      cv::Mat canvas = cv::Mat::zeros(28 * 16, 28 * 16, CV_32F), small;
      cv::polylines(canvas, polyline, false, cv::Scalar(1), static_cast<int>(width * 16), cv::LINE_8, 8);
      cv::resize(canvas, small, {28, 28}, 0, 0, cv::INTER_AREA);
      const Image image = drawn(path, width), other(small.begin<float>(), small.end<float>());
      EXPECT_LT(mean_difference(image, other), 0.005) << points << " points, width " << width;
      EXPECT_LT(largest_difference(image, other), 0.2) << points << " points, width " << width;
    }
}

// The framing and the ink against brute force: where the box's centre goes follows from the brute-force mass.
TEST(Coverage, BoxAgreesWithBruteForceCoverage) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const Xy path = wander(seed, 12);
    const double width = 1.5;
    double low[2] = {1e9, 1e9}, high[2] = {-1e9, -1e9};
    for (std::size_t i = 0; i < path.size(); ++i) {
      low[i % 2] = std::min(low[i % 2], double{path[i]});
      high[i % 2] = std::max(high[i % 2], double{path[i]});
    }
    const double scale = (20 - width) / std::max(high[0] - low[0], high[1] - low[1]);
    const auto placed = [&](double at_x, double at_y) {
      std::vector<double> px;
      for (std::size_t i = 0; i < path.size(); i += 2) {
        px.push_back((path[i] - (low[0] + high[0]) / 2) * scale + at_x);
        px.push_back(((low[1] + high[1]) / 2 - path[i + 1]) * scale + at_y);
      }
      return brute_force(px, width);
    };
    const Centre mass = centre_of_mass(placed(14, 14));
    const double room_x = 14 - ((high[0] - low[0]) * scale + width) / 2;
    const double room_y = 14 - ((high[1] - low[1]) * scale + width) / 2;
    const Image exact =
        placed(14 + std::clamp(14 - mass.x, -room_x, room_x), 14 + std::clamp(14 - mass.y, -room_y, room_y));
    EXPECT_LT(mean_difference(drawn(path, width, Framing::box), exact), 0.002) << seed;
  }
}

// An L with a heavy corner has its mass far from its box's centre; none of it may be lost for that.
TEST(Coverage, ABoxLosesNoInk) {
  Xy path{0, 0.4f, 0, 0, 0.4f, 0};
  for (int i = 0; i < 12; ++i) path.insert(path.end(), {0.14f, 0.012f * i, 0, 0.012f * i + 0.006f});
  std::vector<double> px;
  for (std::size_t i = 0; i < path.size(); i += 2) {
    px.push_back(4.5 + path[i] * 19 / 0.4);
    px.push_back(23.5 - path[i + 1] * 19 / 0.4);
  }
  const Image image = drawn(path, 1, Framing::box), exact = brute_force(px, 1);
  EXPECT_NEAR(ink(image), ink(exact), 0.01 * ink(exact));
  EXPECT_GT(centre_of_mass(image).y, 14.5);  // the mass did not get to its place
}

}  // namespace
}  // namespace hbr
