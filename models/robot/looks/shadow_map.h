// Where a parallel light comes to.
#pragma once

#include <vector>

#include "models/robot/looks/raster.h"
#include "models/robot/looks/triangles.h"

namespace hbr::inline robots {

// What a parallel light sees: a point is in shadow where something else stands nearer to the light.
class ShadowMap {
 public:
  // A light that travels along `travels`, and lights all within `radius` of the centre, m.
  ShadowMap(const std::vector<Triangle>& triangles, const Eigen::Vector3f& travels,
            const Eigen::Vector3f& centre, float radius);

  // The lit share of a disc of `radius` metres about the point, at least `bias` metres off what shades it.
  // The samples' grid is shifted by `jitter` in [0, 1)^2, so that their spacing shows as grain, not as
  // stripes.
  float lit(const Eigen::Vector3f& p, float radius, float bias, const Eigen::Vector2f& jitter) const;

 private:
  Projected project(const Eigen::Vector3f& p) const;

  Eigen::Matrix3f axes_;
  Eigen::Vector3f centre_;
  float per_metre_;
  DepthBuffer map_;
};

}  // namespace hbr::inline robots
