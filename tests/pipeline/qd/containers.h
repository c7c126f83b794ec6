// Every container and every selector, made as their tables say: the rows of the shared contract tests.
#pragma once

#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "pipeline/qd/containers.h"
#include "pipeline/qd/selectors.h"

namespace hbr {

struct ContainerCase {
  std::string name;
  // For descriptors of size d: 1 to 8, about [0, 1]^d.
  std::function<std::unique_ptr<Repertoire>(int genes, int d)> make;
  // Whether at most one of two places may hold an elite, found without any structure.
  std::function<bool(const float* a, const float* b, int d)> same_niche;
  // Whether an elite may only give way to a fitter one, in the same niche.
  bool fitter_only;
};
inline void PrintTo(const ContainerCase& c, std::ostream* out) { *out << c.name; }

inline float plain_distance(const float* a, const float* b, int d) {
  float sum = 0;
  for (int i = 0; i < d; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

// The spacing that leaves room for some hundred elites.
inline float test_spacing(int d) { return d == 1 ? 0.004f : 0.06f * static_cast<float>(d - 1); }
inline int test_cells(int d) { return std::max(2, static_cast<int>(std::pow(150.0, 1.0 / d))); }
inline Container test_container(const std::string& name, int genes, int d) {
  return container_kind(name).make(genes, d, {test_spacing(d), 0.1, 15, test_cells(d), 120, 0, 1},
                                   Seed(33).child(d));
}
inline const Rows& test_centroids(int d) {
  static std::map<int, Rows> made;
  if (!made.contains(d)) made[d] = test_container("cvt", 1, d).centroids;
  return made[d];
}

// What each container promises, one row for each of the table. A container without a row stops the tests.
inline std::vector<ContainerCase> all_containers() {
  using Niche = std::function<bool(const float*, const float*, int)>;
  const Niche apart = [](const float* a, const float* b, int d) {
    return plain_distance(a, b, d) < 0.9f * test_spacing(d) - 1e-6f;
  };
  const auto cell = [](float x, int cells) {
    return std::min(cells - 1, std::max(0, static_cast<int>(std::floor(x * static_cast<float>(cells)))));
  };
  const Niche same_cell = [cell](const float* a, const float* b, int d) {
    for (int i = 0; i < d; ++i)
      if (cell(a[i], test_cells(d)) != cell(b[i], test_cells(d))) return false;
    return true;
  };
  const auto centroid = [](const Rows& centroids, const float* point) {
    int nearest = 0;
    for (int c = 1; c < centroids.rows(); ++c)
      if (plain_distance(centroids.row(c).data(), point, static_cast<int>(centroids.cols())) <
          plain_distance(centroids.row(nearest).data(), point, static_cast<int>(centroids.cols())))
        nearest = c;
    return nearest;
  };
  const Niche same_centroid = [centroid](const float* a, const float* b, int d) {
    return centroid(test_centroids(d), a) == centroid(test_centroids(d), b);
  };
  const std::map<std::string, std::pair<Niche, bool>> promises{{"distance", {apart, false}},
                                                               {"local_competition", {apart, false}},
                                                               {"grid", {same_cell, true}},
                                                               {"cvt", {same_centroid, true}}};
  std::vector<ContainerCase> all;
  for (const ContainerKind& kind : container_kinds()) {
    const std::string name = kind.name;
    const auto& [same_niche, fitter_only] = promises.at(name);
    all.push_back({name, [name](int genes, int d) { return test_container(name, genes, d).repertoire; },
                   same_niche, fitter_only});
  }
  return all;
}

inline void PrintTo(const SelectorKind& s, std::ostream* out) { *out << s.name; }

inline constexpr int kTestNeighbours = 5;

// For descriptors of size 2 in about [0, 1]^2.
inline std::unique_ptr<Selector> test_selector(const SelectorKind& kind) {
  return kind.make({2, kTestNeighbours, 0, 1});
}
inline std::vector<SelectorKind> all_selectors() {
  return {selector_kinds().begin(), selector_kinds().end()};
}

}  // namespace hbr
