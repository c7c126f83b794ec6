#include "models/robot/looks/shapes.h"

#include <cmath>
#include <numbers>

#include "pipeline/core/check.h"

namespace hbr::inline robots {
namespace {

constexpr int kBetween = 6;  // rings from one section to the next
constexpr int kCapRings = 8;
constexpr double kPi = std::numbers::pi;

Section between(const std::vector<Section>& s, int i, double t) {
  // Catmull-Rom: through every section, with the neighbours' slope there.
  const int last = static_cast<int>(s.size()) - 1;
  const Section &a = s[std::max(i - 1, 0)], &b = s[i], &c = s[std::min(i + 1, last)],
                &d = s[std::min(i + 2, last)];
  const auto curve = [t](auto p, auto q, auto r, auto u) {
    return decltype(p)(0.5 * ((2 * q) + t * (r - p) + t * t * (2 * p - 5 * q + 4 * r - u) +
                              t * t * t * (3 * q - p - 3 * r + u)));
  };
  return {b.z + t * (c.z - b.z), curve(a.half, b.half, c.half, d.half),
          curve(a.power, b.power, c.power, d.power), curve(a.centre, b.centre, c.centre, d.centre)};
}

class Rings {
 public:
  explicit Rings(int around) : around_(around) {}

  void add(const Section& s) {
    const int first = static_cast<int>(mesh_.vertices.size());
    for (int k = 0; k < around_; ++k) {
      const double angle = 2 * kPi * k / around_, c = std::cos(angle), n = std::sin(angle);
      const double r =
          std::pow(std::pow(std::abs(c), s.power) + std::pow(std::abs(n), s.power), -1 / s.power);
      mesh_.vertices.emplace_back(
          Eigen::Vector3d(s.centre[0] + s.half[0] * r * c, s.centre[1] + s.half[1] * r * n, s.z)
              .cast<float>());
    }
    if (first == 0) return;
    for (int k = 0; k < around_; ++k) {
      const int next = (k + 1) % around_, a = first - around_ + k, b = first - around_ + next;
      const int c = first + next, d = first + k;
      mesh_.triangles.emplace_back(a, b, c);
      mesh_.triangles.emplace_back(a, c, d);
    }
  }

  // Closes the first ring and the last with a fan about its centre.
  Mesh close(const Section& bottom, const Section& top) {
    const int n = static_cast<int>(mesh_.vertices.size()), low = n, high = n + 1;
    mesh_.vertices.emplace_back(Eigen::Vector3d(bottom.centre[0], bottom.centre[1], bottom.z).cast<float>());
    mesh_.vertices.emplace_back(Eigen::Vector3d(top.centre[0], top.centre[1], top.z).cast<float>());
    for (int k = 0; k < around_; ++k) {
      const int next = (k + 1) % around_;
      mesh_.triangles.emplace_back(low, next, k);
      mesh_.triangles.emplace_back(high, n - around_ + k, n - around_ + next);
    }
    smooth_normals(mesh_);
    return std::move(mesh_);
  }

 private:
  int around_;
  Mesh mesh_;
};

// Ring j of a cap, from the section (0) to the end (kCapRings); a dome's end is a point and gets no ring.
Section cap_ring(Section s, const Cap& cap, double direction, int j) {
  const double angle = kPi / 2 * j / kCapRings;
  s.z += direction * cap.height * std::sin(angle);
  s.half *= 1 - cap.round * (1 - std::cos(angle));
  return s;
}
int last_ring(const Cap& cap) { return cap.round < 1 ? kCapRings : kCapRings - 1; }

}  // namespace

Mesh loft(const std::vector<Section>& sections, const Cap& bottom, const Cap& top, int around) {
  HBR_CHECK(!sections.empty() && around >= 3, "sections {}, around {}", sections.size(), around);
  Rings rings(around);
  for (int j = last_ring(bottom); j > 0; --j) rings.add(cap_ring(sections.front(), bottom, -1, j));
  for (int i = 0; i + 1 < static_cast<int>(sections.size()); ++i)
    for (int k = 0; k < kBetween; ++k) rings.add(between(sections, i, static_cast<double>(k) / kBetween));
  rings.add(sections.back());
  for (int j = 1; j <= last_ring(top); ++j) rings.add(cap_ring(sections.back(), top, 1, j));
  return rings.close(cap_ring(sections.front(), bottom, -1, kCapRings),
                     cap_ring(sections.back(), top, 1, kCapRings));
}

Mesh capsule(double radius, double length) {
  const Cap dome{radius, 1};
  return loft({{-length / 2, {radius, radius}}, {length / 2, {radius, radius}}}, dome, dome, 24);
}

Mesh ellipsoid(const Eigen::Vector3d& half, double power) {
  const Cap dome{half[2], 1};
  return loft({{0, half.head<2>(), power}}, dome, dome);
}

Mesh cylinder(double radius, double length, double rounding) {
  const Cap edge{rounding, rounding / radius};
  const double z = length / 2 - rounding;
  return loft({{-z, {radius, radius}}, {z, {radius, radius}}}, edge, edge);
}

Mesh rounded_box(const Eigen::Vector3d& size, double rounding) {
  const Eigen::Vector2d half = size.head<2>() / 2;
  const Cap edge{rounding, rounding / half.minCoeff()};
  const double z = size[2] / 2 - rounding;
  return loft({{-z, half, 8}, {z, half, 8}}, edge, edge);
}

Mesh torus(double radius, double tube) {
  constexpr int kAround = 40, kTube = 16;
  Mesh mesh;
  for (int i = 0; i < kAround; ++i)
    for (int j = 0; j < kTube; ++j) {
      const double a = 2 * kPi * i / kAround, b = 2 * kPi * j / kTube, r = radius + tube * std::cos(b);
      mesh.vertices.emplace_back(
          Eigen::Vector3d(r * std::cos(a), r * std::sin(a), tube * std::sin(b)).cast<float>());
      const int i1 = (i + 1) % kAround, j1 = (j + 1) % kTube;
      const int p = i * kTube + j, q = i1 * kTube + j, s = i1 * kTube + j1, t = i * kTube + j1;
      mesh.triangles.emplace_back(p, q, s);
      mesh.triangles.emplace_back(p, s, t);
    }
  smooth_normals(mesh);
  return mesh;
}

Mesh rod(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double radius) {
  const Eigen::Vector3d along = b - a;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translate((a + b) / 2);
  pose.rotate(Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), along));
  return moved(capsule(radius, along.norm()), pose);
}

}  // namespace hbr::inline robots
