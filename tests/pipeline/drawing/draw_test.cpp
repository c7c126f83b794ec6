#include "pipeline/drawing/draw.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "pipeline/core/check.h"
#include "pipeline/core/random.h"

namespace hbr {
namespace {

constexpr double kHalfSide = 0.64;  // m
constexpr double kPixelsPerMetre = 28 / (2 * kHalfSide);

using Xy = std::vector<float>;
using Image = std::vector<float>;

Image drawn(const Xy& path, double width, Framing framing = Framing::workspace) {
  Image image(kImagePixels, -1);
  draw(path.data(), static_cast<Eigen::Index>(path.size() / 2), width, framing, kHalfSide, image.data());
  return image;
}

double ink(const Image& image) { return std::accumulate(image.begin(), image.end(), 0.0); }

struct Centre {
  double x, y;
};
Centre centre_of_mass(const Image& image) {
  double x = 0, y = 0;
  for (int i = 0; i < kImagePixels; ++i) {
    x += image[i] * (i % 28);
    y += image[i] * (i / 28);
  }
  return {x / ink(image), y / ink(image)};
}

double largest_difference(const Image& a, const Image& b) {
  double largest = 0;
  for (int i = 0; i < kImagePixels; ++i) largest = std::max(largest, double{std::abs(a[i] - b[i])});
  return largest;
}
double mean_difference(const Image& a, const Image& b) {
  double sum = 0;
  for (int i = 0; i < kImagePixels; ++i) sum += std::abs(a[i] - b[i]);
  return sum / kImagePixels;
}

// A wandering pen that turns smoothly, in the middle of the workspace.
Xy wander(std::uint64_t seed, int points, double length_m = 1.2) {
  Rng rng(Seed(seed).child("wander"));
  Xy path{rng.uniform(-0.1f, 0.1f), rng.uniform(-0.1f, 0.1f)};
  float heading = rng.uniform(-3.14f, 3.14f);
  const auto step = static_cast<float>(length_m / points);
  for (int i = 1; i < points; ++i) {
    heading += rng.uniform(-1, 1) * 8 / static_cast<float>(points);
    path.push_back(std::clamp(path[2 * i - 2] + step * std::cos(heading), -0.45f, 0.45f));
    path.push_back(std::clamp(path[2 * i - 1] + step * std::sin(heading), -0.45f, 0.45f));
  }
  return path;
}

Xy mapped(const Xy& path, double scale, double dx, double dy) {
  Xy result = path;
  for (std::size_t i = 0; i < path.size(); i += 2) {
    result[i] = static_cast<float>(path[i] * scale + dx);
    result[i + 1] = static_cast<float>(path[i + 1] * scale + dy);
  }
  return result;
}

// Share of 24 x 24 points of each pixel that lie within half a width of the path, given in pixels.
Image brute_force(const std::vector<double>& px, double width) {
  constexpr int kSub = 24;
  Image image(kImagePixels);
  for (int row = 0; row < 28; ++row)
    for (int column = 0; column < 28; ++column) {
      int inside = 0;
      for (int s = 0; s < kSub * kSub; ++s) {
        const double x = column + (s % kSub + 0.5) / kSub, y = row + (s / kSub + 0.5) / kSub;
        double nearest = std::numeric_limits<double>::max();
        for (std::size_t i = 0; i + 3 < px.size(); i += 2) {
          const double ex = px[i + 2] - px[i], ey = px[i + 3] - px[i + 1], l2 = ex * ex + ey * ey;
          const double t = l2 > 0 ? std::clamp(((x - px[i]) * ex + (y - px[i + 1]) * ey) / l2, 0.0, 1.0) : 0;
          nearest = std::min(nearest, std::hypot(x - px[i] - t * ex, y - px[i + 1] - t * ey));
        }
        inside += nearest <= width / 2;
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

TEST(Draw, WorkspaceAgreesWithBruteForceCoverage) {
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
TEST(Draw, WorkspaceAgreesWithOpenCv) {
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

// How the line lies on the pixels matters least when averaged; a diagonal through pixel centres is the worst.
TEST(Draw, InkOfALineIsItsWidthTimesLengthAtAnyAngle) {
  for (const double width : {1.0, 1.1, 1.73, 2.0, 2.9, 4.0})
    for (int degrees = 0; degrees < 180; degrees += 15) {
      const double angle = degrees * std::numbers::pi / 180, half = 0.4;
      const auto x = static_cast<float>(half * std::cos(angle)),
                 y = static_cast<float>(half * std::sin(angle));
      const double length = 2 * half * kPixelsPerMetre;
      const double area = width * length + std::numbers::pi * width * width / 4;
      double mean = 0;
      for (int i = 0; i < 8; ++i) {
        const float shift = static_cast<float>(i / (8 * kPixelsPerMetre));
        const double found = ink(drawn({-x + shift, -y, x + shift, y}, width));
        EXPECT_NEAR(found, area, 0.025 * area) << degrees << " degrees, " << width;
        mean += found / 8;
      }
      EXPECT_NEAR(mean, area, 0.006 * area) << degrees << " degrees, " << width;
    }
}

TEST(Draw, AcrossAnUprightOrLevelLineTheInkIsTheWidth) {
  for (const double width : {1.0, 1.21, 2.5, 3.99})
    for (const float offset : {0.0f, 0.007f, 0.0191f}) {
      const Image level = drawn({-0.4f, offset, 0.4f, offset}, width);
      const Image upright = drawn({offset, -0.4f, offset, 0.4f}, width);
      double across_level = 0, across_upright = 0;
      for (int i = 0; i < 28; ++i) {
        across_level += level[i * 28 + 14];
        across_upright += upright[14 * 28 + i];
      }
      EXPECT_NEAR(across_level, width, 1e-4);
      EXPECT_NEAR(across_upright, width, 1e-4);
    }
}

TEST(Draw, MoreWidthIsMoreInkEverywhere) {
  for (const Framing framing : {Framing::workspace, Framing::box}) {
    const Xy path = wander(7, 30);
    Image before = drawn(path, 1, framing);
    for (double width = 1.1; width < 4.05; width += 0.1) {
      const Image image = drawn(path, width, framing);
      EXPECT_GT(ink(image), ink(before)) << width;
      for (int i = 0; framing == Framing::workspace && i < kImagePixels; ++i)
        ASSERT_GE(image[i], before[i]) << width;
      before = image;
    }
  }
}

TEST(Draw, UpInTheWorldIsUpInTheImage) {
  const Centre centre = centre_of_mass(drawn({-0.3f, 0.5f, 0.1f, 0.5f}, 2));
  EXPECT_NEAR(centre.x, (-0.1 + kHalfSide) * kPixelsPerMetre - 0.5, 0.02);
  EXPECT_NEAR(centre.y, (kHalfSide - 0.5) * kPixelsPerMetre - 0.5, 0.02);
}

TEST(Draw, MirroredPathsMakeMirroredImages) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Xy path = wander(seed, 25);
    Xy mirror = path;
    for (std::size_t i = 0; i < path.size(); i += 2) mirror[i] = -path[i];
    const Image image = drawn(path, 1.7), other = drawn(mirror, 1.7);
    for (int y = 0; y < 28; ++y)
      for (int x = 0; x < 28; ++x) ASSERT_NEAR(image[y * 28 + x], other[y * 28 + 27 - x], 1e-4);
  }
}

TEST(Draw, OutsideTheWorkspaceNothingIsSeen) {
  EXPECT_EQ(ink(drawn({0.9f, -5, 0.9f, 5}, 4)), 0);
  EXPECT_EQ(ink(drawn({1e30f, 1e30f}, 4)), 0);
  const Image through = drawn({-1e4f, 0, 1e4f, 0}, 2);
  EXPECT_NEAR(ink(through), 2 * 28, 0.05);
  const Image right = drawn({0.6f, 0, 2, 0.01f}, 2);  // leaves to the right and must not come in at the left
  for (int i = 0; i < kImagePixels; ++i) EXPECT_TRUE(i % 28 > 20 || right[i] == 0) << i;
}

TEST(Draw, ABoxForgetsPlaceAndScale) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Xy path = wander(seed, 25);
    const Image image = drawn(path, 1.7, Framing::box);
    EXPECT_LT(largest_difference(image, drawn(mapped(path, 1, 0.13, -0.21), 1.7, Framing::box)), 1e-3);
    EXPECT_LT(largest_difference(image, drawn(mapped(path, 0.25, 0, 0), 1.7, Framing::box)), 1e-3);
  }
}

TEST(Draw, ABoxIsTwentyPixelsAndItsMassIsCentred) {
  int centred = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const double width = 1 + 0.06 * static_cast<double>(seed);
    const Image image = drawn(wander(seed, 25), width, Framing::box);
    int left = 28, right = -1, top = 28, bottom = -1;
    for (int i = 0; i < kImagePixels; ++i)
      if (image[i] > 0) {
        left = std::min(left, i % 28), right = std::max(right, i % 28);
        top = std::min(top, i / 28), bottom = std::max(bottom, i / 28);
      }
    const double side = 1 + std::max(right - left, bottom - top);
    EXPECT_GE(side, 20) << seed;
    EXPECT_LE(side, 22) << seed;
    const bool touches = left == 0 || top == 0 || right == 27 || bottom == 27;
    const Centre centre = centre_of_mass(image);
    if (touches) continue;
    ++centred;
    EXPECT_NEAR(centre.x, 14, 0.06) << seed;
    EXPECT_NEAR(centre.y, 14, 0.06) << seed;
  }
  EXPECT_GT(centred, 25);
}

// The framing and the ink against brute force: where the box's centre goes follows from the brute-force mass.
TEST(Draw, BoxAgreesWithBruteForceCoverage) {
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
TEST(Draw, ABoxLosesNoInk) {
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

TEST(Draw, PathsWithoutExtentAreDots) {
  const double dot = std::numbers::pi * 9 / 4;
  for (const Framing framing : {Framing::workspace, Framing::box})
    for (const Xy& path : {Xy{0, 0}, Xy{0, 0, 0, 0, 0, 0}, Xy{0.2f, 0.3f}, Xy{0.2f, 0.3f, 0.2f, 0.3f},
                           Xy{0.2f, 0.3f, 0.2000001f, 0.3f}, Xy{1e-20f, 0, 0, 1e-38f}}) {
      const Image image = drawn(path, 3, framing);
      EXPECT_NEAR(ink(image), dot, 0.03 * dot);
      if (framing == Framing::box) {
        EXPECT_NEAR(centre_of_mass(image).x, 14, 0.02);
        EXPECT_NEAR(centre_of_mass(image).y, 14, 0.02);
      }
    }
}

TEST(Draw, InkIsBetweenNoneAndAll) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Rng rng(Seed(seed).child("scribble"));
    Xy path;
    for (int i = 0; i < 40; ++i) path.push_back(rng.uniform(-0.7f, 0.7f));
    for (const Framing framing : {Framing::workspace, Framing::box})
      for (const float value : drawn(path, 1 + 3 * rng.uniform(), framing)) {
        ASSERT_GE(value, 0);
        ASSERT_LE(value, 1);
      }
  }
}

TEST(Draw, KnowsItsFramings) {
  EXPECT_EQ(framing_named("box"), Framing::box);
  EXPECT_EQ(framing_named("workspace"), Framing::workspace);
  EXPECT_THROW(framing_named("frame"), InputError);
}

TEST(DrawDeathTest, RefusesAPointThatIsNotFinite) {
  EXPECT_DEATH(drawn({0, 0, std::numeric_limits<float>::quiet_NaN(), 0}, 2), "not finite");
  EXPECT_DEATH(drawn({0, 0, 0, std::numeric_limits<float>::infinity()}, 2, Framing::box), "not finite");
}

TEST(Draw, BytesAreRounded) {
  Image image(kImagePixels, 0.5f);
  image[0] = 0;
  image[1] = 1;
  image[2] = 0.0019f;
  image[3] = 0.0020f;
  std::vector<std::uint8_t> bytes(kImagePixels);
  image_to_bytes(image.data(), bytes.data());
  EXPECT_EQ(bytes[0], 0);
  EXPECT_EQ(bytes[1], 255);
  EXPECT_EQ(bytes[2], 0);
  EXPECT_EQ(bytes[3], 1);
  EXPECT_EQ(bytes[4], 128);
}

}  // namespace
}  // namespace hbr
