#include "models/simbody/render.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "models/simbody/raster.h"
#include "pipeline/core/check.h"

namespace hbr {
namespace {

using Eigen::Vector3f;

constexpr int kFiner = 3;  // rendered that much larger, then averaged
constexpr int kShadowSize = 2048;
constexpr float kNear = 0.01f;  // m

// Light is linear; pictures are sRGB.
float to_linear(float c) { return std::pow(c, 2.2f); }
Vector3f to_linear(const Vector3f& c) { return {to_linear(c[0]), to_linear(c[1]), to_linear(c[2])}; }

struct Triangle {
  Vector3f corner[3], normal[3];
  Vector3f colour;  // linear
  float opacity;
};

std::vector<Triangle> triangles_of(const std::vector<Posed>& bodies, bool solid) {
  std::vector<Triangle> result;
  for (const Posed& body : bodies) {
    const Eigen::Isometry3f pose = body.pose.cast<float>();
    for (const Mesh& mesh : body.meshes) {
      if ((mesh.opacity >= 1) != solid) continue;
      for (const Eigen::Vector3i& t : mesh.triangles) {
        Triangle out;
        out.colour = to_linear(mesh.colour);
        out.opacity = mesh.opacity;
        for (int k = 0; k < 3; ++k) {
          out.corner[k] = pose * mesh.vertices[t[k]];
          out.normal[k] = pose.linear() * mesh.normals[t[k]];
        }
        result.push_back(out);
      }
    }
  }
  return result;
}

// Rows: right, down, forward.
Eigen::Matrix3f axes(const Vector3f& forward) {
  Eigen::Matrix3f m;
  const Vector3f right = forward.cross(Vector3f::UnitZ()).normalized();
  m.row(0) = right;
  m.row(1) = forward.cross(right);
  m.row(2) = forward;
  return m;
}

// What a parallel light sees: a point is in shadow where something else stands nearer to the light.
class ShadowMap {
 public:
  ShadowMap(const std::vector<Triangle>& triangles, const Vector3f& travels, const Vector3f& centre,
            float radius)
      : axes_(axes(travels)),
        centre_(centre),
        per_metre_(kShadowSize / (2 * radius)),
        map_(kShadowSize, kShadowSize) {
    for (const Triangle& t : triangles)
      scan_triangle(project(t.corner[0]), project(t.corner[1]), project(t.corner[2]), kShadowSize,
                    kShadowSize, [&](int column, int row, float depth, float, float, float) {
                      float& nearest = map_.at(column, row);
                      nearest = std::min(nearest, depth);
                    });
  }

  // The lit share of a disc of `radius` metres about the point, at least `bias` metres off what shades it.
  // The samples' grid is shifted by `jitter` in [0, 1)^2, so that their spacing shows as grain, not as
  // stripes.
  float lit(const Vector3f& p, float radius, float bias, const Eigen::Vector2f& jitter) const {
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

 private:
  Projected project(const Vector3f& p) const {
    const Vector3f q = axes_ * (p - centre_);
    return {q[0] * per_metre_ + kShadowSize / 2, q[1] * per_metre_ + kShadowSize / 2, q[2], 1};
  }

  Eigen::Matrix3f axes_;
  Vector3f centre_;
  float per_metre_;
  DepthBuffer map_;
};

class View {
 public:
  View(const Camera& camera, int width, int height)
      : eye(camera.eye.cast<float>()),
        width_(width),
        height_(height),
        axes_(axes((camera.target - camera.eye).normalized().cast<float>())),
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

struct Lights {
  Vector3f to_key, to_fill;
};

Vector3f shade(const Triangle& t, const Vector3f& p, Vector3f n, const Vector3f& eye, const Lights& lights,
               const ShadowMap& shadow, const Eigen::Vector2f& jitter) {
  const Vector3f to_eye = (eye - p).normalized();
  if (n.dot(to_eye) < 0) n = (n - 1.01f * n.dot(to_eye) * to_eye).normalized();
  const float lit = shadow.lit(p + 0.002f * n, 0.006f, 0.004f, jitter);
  const float key = std::max(0.f, n.dot(lights.to_key)) * lit, fill = std::max(0.f, n.dot(lights.to_fill));
  const float sky = 0.5f + 0.5f * n[2];
  const Vector3f light = 0.66f * key * Vector3f(1.f, .98f, .95f) + 0.20f * fill * Vector3f(.88f, .94f, 1.f) +
                         Vector3f(.26f, .265f, .275f) * (0.45f + 0.75f * sky);
  const float shine = std::pow(std::max(0.f, n.dot((lights.to_key + to_eye).normalized())), 48.f) * lit;
  const float rim = std::pow(1 - std::max(0.f, n.dot(to_eye)), 4.f);
  return t.colour.cwiseProduct(light) + Vector3f::Constant(0.16f * shine + 0.05f * rim);
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

// Floor and wall without a seam: light, a little darker away from the middle, with the scene's shadow.
Vector3f background(const Vector3f& eye, const Vector3f& ray, float floor, float height,
                    const Vector3f& centre, float radius, const ShadowMap& shadow,
                    const Eigen::Vector2f& jitter) {
  const Vector3f upper(.80f, .85f, .90f), lower(.955f, .96f, .965f);
  const Vector3f base = to_linear(Vector3f(lower + (upper - lower) * height));
  if (ray[2] >= -1e-3f) return base;
  const Vector3f p = eye + ray * ((floor - eye[2]) / ray[2]);
  const float away = (p - Vector3f(centre[0], centre[1], floor)).norm() / radius;
  const float fade = std::max(0.f, 1 - away * away / 2.2f);
  if (fade <= 0) return base;
  return base * (1 - 0.42f * fade * (1 - shadow.lit(p, 0.028f, 0.003f, jitter)));
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
  const Eigen::Matrix3f seen = axes((camera.target - camera.eye).normalized().cast<float>());
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

Camera camera_for(const Scene& scene, const Eigen::Vector3d& direction, double view_rad, double aspect) {
  const std::vector<Triangle> solid = triangles_of(scene.bodies, true);
  const Eigen::Matrix3d seen = axes(direction.normalized().cast<float>()).cast<double>();
  constexpr double kMargin = 0.94;
  const double up = kMargin * std::tan(view_rad / 2), side = up * aspect;
  // In the camera's axes: the four planes that hold everything, then the eye where the tighter pair meets.
  double left = -1e9, right = -1e9, top = -1e9, bottom = -1e9;
  for (const Triangle& t : solid)
    for (const Vector3f& corner : t.corner) {
      const Eigen::Vector3d q = seen * corner.cast<double>();
      left = std::max(left, -q[0] - side * q[2]);
      right = std::max(right, q[0] - side * q[2]);
      top = std::max(top, -q[1] - up * q[2]);
      bottom = std::max(bottom, q[1] - up * q[2]);
    }
  const Eigen::Vector3d at((right - left) / 2, (bottom - top) / 2,
                           -std::max((right + left) / (2 * side), (bottom + top) / (2 * up)));
  const Eigen::Vector3d eye = seen.transpose() * at;
  return {eye, eye + direction.normalized(), view_rad};
}

void write_png(const std::filesystem::path& path, const cv::Mat3b& picture) {
  bool written = false;
  try {
    written = cv::imwrite(path.string(), picture);
  } catch (const cv::Exception&) {
  }
  if (!written) throw InputError("{}: the picture can't be written", path.string());
}

}  // namespace hbr
