#include "models/robot/looks/simplify.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace hbr::inline robots {
namespace {

constexpr std::size_t kStride = sizeof(Eigen::Vector3f);

// A mesh by places: vertices that lie in one place are one, whatever their normals.
struct Welded {
  std::vector<Eigen::Vector3f> places;
  std::vector<std::vector<Eigen::Vector3f>> normals;  // of each place, each once
  std::vector<unsigned> corners;                      // three a triangle
  double scale = 1;                                   // m, of a deviation of 1 as meshoptimizer has it

  explicit Welded(const Mesh& mesh) {
    const std::size_t n = mesh.vertices.size();
    std::vector<unsigned> place(n);
    const std::size_t count =
        meshopt_generateVertexRemap(place.data(), nullptr, n, mesh.vertices.data(), n, kStride);
    places.resize(count);
    normals.resize(count);
    for (std::size_t i = 0; i < n; ++i) {
      places[place[i]] = mesh.vertices[i];
      std::vector<Eigen::Vector3f>& known = normals[place[i]];
      if (std::ranges::find(known, mesh.normals[i]) == known.end()) known.push_back(mesh.normals[i]);
    }
    for (const Eigen::Vector3i& t : mesh.triangles) {
      const unsigned a = place[t[0]], b = place[t[1]], c = place[t[2]];
      if (a != b && b != c && c != a) corners.insert(corners.end(), {a, b, c});
    }
    if (count > 0) scale = meshopt_simplifyScale(places.data()->data(), count, kStride);
  }

  // Its triangles with a deviation of so many metres.
  std::vector<unsigned> within(double deviation) const {
    std::vector<unsigned> kept(corners.size());
    if (kept.empty()) return kept;
    const auto relative = static_cast<float>(std::min(deviation / scale, 1.));
    kept.resize(meshopt_simplify(kept.data(), corners.data(), corners.size(), places.data()->data(),
                                 places.size(), kStride, 0, relative));
    return kept;
  }

  // Each corner gets, of the normals of its place, the one nearest to its triangle's.
  Mesh mesh_of(const std::vector<unsigned>& kept, const Mesh& original) const {
    Mesh mesh;
    mesh.colour = original.colour;
    mesh.opacity = original.opacity;
    std::map<std::pair<unsigned, std::size_t>, int> vertices;  // by place and normal
    for (std::size_t t = 0; t < kept.size(); t += 3) {
      const Eigen::Vector3f &a = places[kept[t]], &b = places[kept[t + 1]], &c = places[kept[t + 2]];
      const Eigen::Vector3f across = (b - a).cross(c - a);
      Eigen::Vector3i triangle;
      for (int k = 0; k < 3; ++k) {
        const unsigned place = kept[t + static_cast<std::size_t>(k)];
        const auto best = std::ranges::max_element(
            normals[place], {}, [&](const Eigen::Vector3f& normal) { return normal.dot(across); });
        const auto which = static_cast<std::size_t>(best - normals[place].begin());
        const auto [vertex, fresh] =
            vertices.try_emplace({place, which}, static_cast<int>(mesh.vertices.size()));
        if (fresh) {
          mesh.vertices.push_back(places[place]);
          mesh.normals.push_back(*best);
        }
        triangle[k] = vertex->second;
      }
      mesh.triangles.push_back(triangle);
    }
    return mesh;
  }
};

std::size_t corners_in(const std::vector<std::vector<unsigned>>& kept) {
  std::size_t sum = 0;
  for (const std::vector<unsigned>& corners : kept) sum += corners.size();
  return sum;
}

}  // namespace

Simplified simplified(const std::vector<Mesh>& meshes, std::size_t triangles, double enough,
                      Workers& workers) {
  std::vector<Welded> welded;
  double widest = enough;  // m
  for (const Mesh& mesh : meshes) {
    welded.emplace_back(mesh);
    widest = std::max(widest, welded.back().scale);
  }
  const auto within = [&](double metres) {
    std::vector<std::vector<unsigned>> result(meshes.size());
    workers.for_each(meshes.size(), [&](std::size_t i) {
      result[i] = metres > 0 ? welded[i].within(metres) : welded[i].corners;
    });
    return result;
  };
  double deviation = enough;
  std::vector<std::vector<unsigned>> kept = within(enough);
  if (corners_in(kept) > 3 * triangles) {
    // By halves, on a scale of magnitudes.
    double low = std::log(std::max(enough, 1e-6 * widest)), high = std::log(widest);
    kept = within(widest);
    for (int i = 0; i < 10; ++i) {
      const double middle = (low + high) / 2;
      std::vector<std::vector<unsigned>> tried = within(std::exp(middle));
      if (corners_in(tried) <= 3 * triangles) {
        high = middle;
        kept = std::move(tried);
      } else {
        low = middle;
      }
    }
    deviation = std::exp(high);
  }
  Simplified result{{}, deviation};
  for (std::size_t i = 0; i < meshes.size(); ++i)
    result.meshes.push_back(welded[i].mesh_of(kept[i], meshes[i]));
  return result;
}

}  // namespace hbr::inline robots
