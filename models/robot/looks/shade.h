// Colours of what a picture shows, linear.
#pragma once

#include "models/robot/looks/shadow_map.h"

namespace hbr::inline robots {

// Directions towards the lights; the key light casts shadows.
struct Lights {
  Eigen::Vector3f to_key, to_fill;
};

// A surface's point and its normal there, seen from the eye.
Eigen::Vector3f shade(const Triangle& triangle, const Eigen::Vector3f& point, Eigen::Vector3f normal,
                      const Eigen::Vector3f& eye, const Lights& lights, const ShadowMap& shadow,
                      const Eigen::Vector2f& jitter);

// Floor and wall without a seam: light, a little darker away from the middle, with the scene's shadow.
Eigen::Vector3f background(const Eigen::Vector3f& eye, const Eigen::Vector3f& ray, float floor, float height,
                           const Eigen::Vector3f& centre, float radius, const ShadowMap& shadow,
                           const Eigen::Vector2f& jitter);

}  // namespace hbr::inline robots
