// Paths to draw, and what is measured of their images.
#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "pipeline/core/random.h"
#include "pipeline/drawing/draw.h"

namespace hbr {

inline constexpr double kHalfSide = 0.64;  // m
inline constexpr double kPixelsPerMetre = 28 / (2 * kHalfSide);

using Xy = std::vector<float>;
using Image = std::vector<float>;

inline Image drawn(const Xy& path, double width, Framing framing = Framing::workspace) {
  Image image(kImagePixels, -1);
  draw(path.data(), static_cast<Eigen::Index>(path.size() / 2), width, framing, kHalfSide, image.data());
  return image;
}

inline double ink(const Image& image) { return std::accumulate(image.begin(), image.end(), 0.0); }

struct Centre {
  double x, y;
};
inline Centre centre_of_mass(const Image& image) {
  double x = 0, y = 0;
  for (int i = 0; i < kImagePixels; ++i) {
    x += image[i] * (i % 28);
    y += image[i] * (i / 28);
  }
  return {x / ink(image), y / ink(image)};
}

inline double largest_difference(const Image& a, const Image& b) {
  double largest = 0;
  for (int i = 0; i < kImagePixels; ++i) largest = std::max(largest, double{std::abs(a[i] - b[i])});
  return largest;
}
inline double mean_difference(const Image& a, const Image& b) {
  double sum = 0;
  for (int i = 0; i < kImagePixels; ++i) sum += std::abs(a[i] - b[i]);
  return sum / kImagePixels;
}

// A wandering pen that turns smoothly, in the middle of the workspace.
inline Xy wander(std::uint64_t seed, int points, double length_m = 1.2) {
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

inline Xy mapped(const Xy& path, double scale, double dx, double dy) {
  Xy result = path;
  for (std::size_t i = 0; i < path.size(); i += 2) {
    result[i] = static_cast<float>(path[i] * scale + dx);
    result[i + 1] = static_cast<float>(path[i + 1] * scale + dy);
  }
  return result;
}

}  // namespace hbr
