#include "models/robot/looks/shade.h"

#include <algorithm>
#include <cmath>

namespace hbr::inline robots {

Eigen::Vector3f shade(const Triangle& t, const Eigen::Vector3f& p, Eigen::Vector3f n,
                      const Eigen::Vector3f& eye, const Lights& lights, const ShadowMap& shadow,
                      const Eigen::Vector2f& jitter) {
  const Eigen::Vector3f to_eye = (eye - p).normalized();
  if (n.dot(to_eye) < 0) n = (n - 1.01f * n.dot(to_eye) * to_eye).normalized();
  const float lit = shadow.lit(p + 0.002f * n, 0.006f, 0.004f, jitter);
  const float key = std::max(0.f, n.dot(lights.to_key)) * lit, fill = std::max(0.f, n.dot(lights.to_fill));
  const float sky = 0.5f + 0.5f * n[2];
  const Eigen::Vector3f light = 0.66f * key * Eigen::Vector3f(1.f, .98f, .95f) +
                                0.20f * fill * Eigen::Vector3f(.88f, .94f, 1.f) +
                                Eigen::Vector3f(.26f, .265f, .275f) * (0.45f + 0.75f * sky);
  const float shine = std::pow(std::max(0.f, n.dot((lights.to_key + to_eye).normalized())), 48.f) * lit;
  const float rim = std::pow(1 - std::max(0.f, n.dot(to_eye)), 4.f);
  return t.colour.cwiseProduct(light) + Eigen::Vector3f::Constant(0.16f * shine + 0.05f * rim);
}

Eigen::Vector3f background(const Eigen::Vector3f& eye, const Eigen::Vector3f& ray, float floor, float height,
                           const Eigen::Vector3f& centre, float radius, const ShadowMap& shadow,
                           const Eigen::Vector2f& jitter) {
  const Eigen::Vector3f upper(.80f, .85f, .90f), lower(.955f, .96f, .965f);
  const Eigen::Vector3f base = to_linear(Eigen::Vector3f(lower + (upper - lower) * height));
  if (ray[2] >= -1e-3f) return base;
  const Eigen::Vector3f p = eye + ray * ((floor - eye[2]) / ray[2]);
  const float away = (p - Eigen::Vector3f(centre[0], centre[1], floor)).norm() / radius;
  const float fade = std::max(0.f, 1 - away * away / 2.2f);
  if (fade <= 0) return base;
  return base * (1 - 0.42f * fade * (1 - shadow.lit(p, 0.028f, 0.003f, jitter)));
}

}  // namespace hbr::inline robots
