#include "models/robot/looks/render.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "models/robot/looks/shade.h"
#include "pipeline/core/check.h"

namespace hbr::inline robots {
namespace {

using Eigen::Vector3f;

constexpr int kFiner = 3;       // rendered that much larger, then averaged
constexpr float kNear = 0.01f;  // m

class View {
 public:
  View(const Camera& camera, int width, int height)
      : eye(camera.eye.cast<float>()),
        width_(width),
        height_(height),
        axes_(axes_along((camera.target - camera.eye).normalized().cast<float>())),
        focal_(static_cast<float>(height / 2 / std::tan(camera.view_rad / 2))) {}

  // Depth is -1 / distance, which is straight on the screen.
  bool project(const Vector3f& p, Projected& out) const {
    const Vector3f q = axes_ * (p - eye);
    if (q[2] < kNear) return false;
    const float w = 1 / q[2];
    out = {static_cast<float>(width_) / 2 + focal_ * q[0] * w,
           static_cast<float>(height_) / 2 + focal_ * q[1] * w, -w, w};
    return true;
  }
  Vector3f ray(int column, int row) const {
    const Vector3f q((static_cast<float>(column) + 0.5f - static_cast<float>(width_) / 2) / focal_,
                     (static_cast<float>(row) + 0.5f - static_cast<float>(height_) / 2) / focal_, 1);
    return (axes_.transpose() * q).normalized();
  }

  const Vector3f eye;

 private:
  int width_, height_;
  Eigen::Matrix3f axes_;
  float focal_;
};

// In [0, 1)^2, as if at random from pixel to pixel (Jarzynski and Olano 2020: pcg2d).
Eigen::Vector2f jitter_of(int column, int row) {
  std::uint32_t x = static_cast<std::uint32_t>(column), y = static_cast<std::uint32_t>(row);
  x = x * 1664525u + 1013904223u, y = y * 1664525u + 1013904223u;
  x += y * 1664525u, y += x * 1664525u;
  x ^= x >> 16, y ^= y >> 16;
  x += y * 1664525u, y += x * 1664525u;
  x ^= x >> 16, y ^= y >> 16;
  return {static_cast<float>(x >> 8) * 0x1p-24f, static_cast<float>(y >> 8) * 0x1p-24f};
}

struct Bounds {
  Vector3f low = Vector3f::Constant(1e9f), high = Vector3f::Constant(-1e9f);
};
Bounds bounds(const std::vector<Triangle>& triangles) {
  Bounds b;
  for (const Triangle& t : triangles)
    for (const Vector3f& corner : t.corner) {
      b.low = b.low.cwiseMin(corner);
      b.high = b.high.cwiseMax(corner);
    }
  return b;
}

}  // namespace

cv::Mat3b render(const Scene& scene, const Camera& camera, int width, int height) {
  const std::vector<Triangle> solid = triangles_of(scene.bodies, true);
  const std::vector<Triangle> glass = triangles_of(scene.bodies, false);
  const int w = width * kFiner, h = height * kFiner;
  const View view(camera, w, h);
  const Bounds b = bounds(solid);
  const Vector3f centre = (b.low + b.high) / 2;
  const float radius = (b.high - b.low).norm() / 2;

  // The key light comes over the viewer's left shoulder, the fill light from the right.
  const Eigen::Matrix3f seen = axes_along((camera.target - camera.eye).normalized().cast<float>());
  const Vector3f right = seen.row(0), back = -seen.row(2).transpose();
  Lights lights;
  lights.to_key = (back * 0.75f - right * 0.75f + Vector3f(0, 0, 1.15f)).normalized();
  lights.to_fill = (back * 0.6f + right * 1.0f + Vector3f(0, 0, 0.25f)).normalized();
  const ShadowMap shadow(solid, -lights.to_key, centre, radius * 1.05f);

  DepthBuffer nearest(w, h);
  std::vector<int> owner(nearest.depth.size(), -1);
  const auto scan = [&](const Triangle& t, auto&& pixel) {
    Projected corner[3];
    for (int k = 0; k < 3; ++k)
      if (!view.project(t.corner[k], corner[k])) return;
    scan_triangle(corner[0], corner[1], corner[2], w, h, pixel);
  };
  for (std::size_t i = 0; i < solid.size(); ++i)
    scan(solid[i], [&](int column, int row, float depth, float, float, float) {
      float& least = nearest.at(column, row);
      if (depth >= least) return;
      least = depth;
      owner[static_cast<std::size_t>(row) * static_cast<std::size_t>(w) + static_cast<std::size_t>(column)] =
          static_cast<int>(i);
    });

  cv::Mat3f picture(h, w);
  for (int row = 0; row < h; ++row)
    for (int column = 0; column < w; ++column) {
      const int i = owner[static_cast<std::size_t>(row) * static_cast<std::size_t>(w) +
                          static_cast<std::size_t>(column)];
      const Vector3f ray = view.ray(column, row);
      const Eigen::Vector2f jitter = jitter_of(column, row);
      Vector3f colour;
      if (i < 0) {
        colour =
            background(view.eye, ray, static_cast<float>(scene.floor),
                       1 - static_cast<float>(row) / static_cast<float>(h), centre, radius, shadow, jitter);
      } else {
        // Where the ray meets the triangle, by its depth; the normal by barycentric coordinates there.
        const Triangle& t = solid[i];
        const Vector3f e1 = t.corner[1] - t.corner[0], e2 = t.corner[2] - t.corner[0], n = e1.cross(e2);
        const float along = n.dot(t.corner[0] - view.eye) / n.dot(ray);
        const Vector3f p = view.eye + along * ray, d = p - t.corner[0];
        const float l1 = d.cross(e2).dot(n) / n.squaredNorm(), l2 = e1.cross(d).dot(n) / n.squaredNorm();
        const Vector3f normal =
            ((1 - l1 - l2) * t.normal[0] + l1 * t.normal[1] + l2 * t.normal[2]).normalized();
        colour = shade(t, p, normal, view.eye, lights, shadow, jitter);
      }
      picture(row, column) = {colour[2], colour[1], colour[0]};
    }

  for (const Triangle& t : glass) {
    if ((t.corner[1] - t.corner[0]).cross(t.corner[2] - t.corner[0]).dot(t.corner[0] - view.eye) > 0)
      continue;
    scan(t, [&](int column, int row, float depth, float, float, float) {
      if (depth >= nearest.at(column, row)) return;
      cv::Vec3f& under = picture(row, column);
      const cv::Vec3f tint(t.colour[2], t.colour[1], t.colour[0]);
      under = under * (1 - t.opacity) + tint * t.opacity;
    });
  }

  cv::Mat3f averaged;
  cv::resize(picture, averaged, {width, height}, 0, 0, cv::INTER_AREA);
  cv::Mat3b result(height, width);
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column)
      for (int k = 0; k < 3; ++k)
        result(row, column)[k] = cv::saturate_cast<uchar>(
            255 * std::pow(std::clamp(averaged(row, column)[k], 0.f, 1.f), 1 / 2.2f));
  return result;
}

void write_png(const std::filesystem::path& path, const cv::Mat3b& picture) {
  bool written = false;
  try {
    written = cv::imwrite(path.string(), picture);
  } catch (const cv::Exception&) {
  }
  if (!written) throw InputError("{}: the picture can't be written", path.string());
}

}  // namespace hbr::inline robots
