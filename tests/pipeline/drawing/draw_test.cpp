#include "pipeline/drawing/draw.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "pipeline/core/check.h"
#include "tests/pipeline/drawing/images.h"

namespace hbr {
namespace {

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
