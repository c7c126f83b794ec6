// Scan conversion of triangles with a depth buffer: the inner part of render.cpp.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

namespace hbr::inline robots {

// Where a vertex falls on the picture: pixels, and a depth that grows away from the viewer. `weight` is
// 1 / distance for a perspective (what is interpolated must be divided by it), 1 for a parallel projection.
struct Projected {
  float x, y, depth, weight;
};

// Calls pixel(column, row, depth, l0, l1, l2) for every pixel whose centre is in the triangle; l are the
// perspective-correct barycentric coordinates. `depth` is interpolated as it is on the screen.
template <class Pixel>
void scan_triangle(const Projected& a, const Projected& b, const Projected& c, int width, int height,
                   Pixel&& pixel) {
  const float area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
  if (!(std::abs(area) > 1e-12f)) return;
  const int left = std::max(0, static_cast<int>(std::floor(std::min({a.x, b.x, c.x}))));
  const int right = std::min(width - 1, static_cast<int>(std::ceil(std::max({a.x, b.x, c.x}))));
  const int top = std::max(0, static_cast<int>(std::floor(std::min({a.y, b.y, c.y}))));
  const int bottom = std::min(height - 1, static_cast<int>(std::ceil(std::max({a.y, b.y, c.y}))));
  for (int row = top; row <= bottom; ++row)
    for (int column = left; column <= right; ++column) {
      const float x = static_cast<float>(column) + 0.5f, y = static_cast<float>(row) + 0.5f;
      const float k0 = ((b.x - x) * (c.y - y) - (c.x - x) * (b.y - y)) / area;
      const float k1 = ((c.x - x) * (a.y - y) - (a.x - x) * (c.y - y)) / area;
      const float k2 = 1 - k0 - k1;
      if (k0 < 0 || k1 < 0 || k2 < 0) continue;
      const float w0 = k0 * a.weight, w1 = k1 * b.weight, w2 = k2 * c.weight, sum = w0 + w1 + w2;
      pixel(column, row, k0 * a.depth + k1 * b.depth + k2 * c.depth, w0 / sum, w1 / sum, w2 / sum);
    }
}

struct DepthBuffer {
  int width, height;
  std::vector<float> depth;
  DepthBuffer(int w, int h)
      : width(w),
        height(h),
        depth(static_cast<std::size_t>(w) * static_cast<std::size_t>(h),
              std::numeric_limits<float>::infinity()) {}
  float& at(int column, int row) {
    return depth[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                 static_cast<std::size_t>(column)];
  }
  float at(int column, int row) const { return const_cast<DepthBuffer&>(*this).at(column, row); }
};

}  // namespace hbr::inline robots
