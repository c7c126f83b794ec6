#include "models/robot/looks/shadow_map.h"

#include <algorithm>

namespace hbr::inline robots {
namespace {

constexpr int kShadowSize = 2048;

}  // namespace

ShadowMap::ShadowMap(const std::vector<Triangle>& triangles, const Eigen::Vector3f& travels,
                     const Eigen::Vector3f& centre, float radius)
    : axes_(axes_along(travels)),
      centre_(centre),
      per_metre_(kShadowSize / (2 * radius)),
      map_(kShadowSize, kShadowSize) {
  for (const Triangle& t : triangles)
    scan_triangle(project(t.corner[0]), project(t.corner[1]), project(t.corner[2]), kShadowSize, kShadowSize,
                  [&](int column, int row, float depth, float, float, float) {
                    float& nearest = map_.at(column, row);
                    nearest = std::min(nearest, depth);
                  });
}

float ShadowMap::lit(const Eigen::Vector3f& p, float radius, float bias,
                     const Eigen::Vector2f& jitter) const {
  const Projected at = project(p);
  const float step = radius * per_metre_ / 4;
  float lit = 0, weights = 0;
  for (int i = -4; i <= 4; ++i)
    for (int j = -4; j <= 4; ++j) {
      if (i * i + j * j > 17) continue;
      const int column = static_cast<int>(at.x + step * (static_cast<float>(i) + jitter[0] - 0.5f));
      const int row = static_cast<int>(at.y + step * (static_cast<float>(j) + jitter[1] - 0.5f));
      const float weight = 1 - static_cast<float>(i * i + j * j) / 20;
      weights += weight;
      if (column < 0 || row < 0 || column >= kShadowSize || row >= kShadowSize ||
          map_.at(column, row) > at.depth - bias)
        lit += weight;
    }
  return lit / weights;
}

Projected ShadowMap::project(const Eigen::Vector3f& p) const {
  const Eigen::Vector3f q = axes_ * (p - centre_);
  return {q[0] * per_metre_ + kShadowSize / 2, q[1] * per_metre_ + kShadowSize / 2, q[2], 1};
}

}  // namespace hbr::inline robots
