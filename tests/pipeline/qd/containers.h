// Every container and every selector, by name: the rows of the shared contract tests.
#pragma once

#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "pipeline/qd/cvt_archive.h"
#include "pipeline/qd/distance_archive.h"
#include "pipeline/qd/grid_archive.h"
#include "pipeline/qd/score_selectors.h"

namespace hbr {

struct Container {
  std::string name;
  // For descriptors of size d: 1 to 8, about [0, 1]^d.
  std::function<std::unique_ptr<Repertoire>(int genes, int d)> make;
  // Whether at most one of two places may hold an elite, found without any structure.
  std::function<bool(const float* a, const float* b, int d)> same_niche;
  // Whether an elite may only give way to a fitter one, in the same niche.
  bool fitter_only;
};
inline void PrintTo(const Container& c, std::ostream* out) { *out << c.name; }

inline float plain_distance(const float* a, const float* b, int d) {
  float sum = 0;
  for (int i = 0; i < d; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

// The spacing that leaves room for some hundred elites.
inline float test_spacing(int d) { return d == 1 ? 0.004f : 0.06f * static_cast<float>(d - 1); }
inline int test_cells(int d) { return std::max(2, static_cast<int>(std::pow(150.0, 1.0 / d))); }
inline const Rows& test_centroids(int d) {
  static std::map<int, Rows> made;
  if (!made.contains(d)) made[d] = cvt_centroids(120, d, 0, 1, Seed(33).child(d));
  return made[d];
}

inline std::vector<Container> all_containers() {
  const auto distance = [](Contest contest) {
    return [contest](int genes, int d) {
      return make_distance_archive(genes, d, {test_spacing(d), 0.1f, 15, 0, 1, contest});
    };
  };
  const auto apart = [](const float* a, const float* b, int d) {
    return plain_distance(a, b, d) < 0.9f * test_spacing(d) - 1e-6f;
  };
  const auto cell = [](float x, int cells) {
    return std::min(cells - 1, std::max(0, static_cast<int>(std::floor(x * static_cast<float>(cells)))));
  };
  const auto centroid = [](const Rows& centroids, const float* point) {
    int nearest = 0;
    for (int c = 1; c < centroids.rows(); ++c)
      if (plain_distance(centroids.row(c).data(), point, static_cast<int>(centroids.cols())) <
          plain_distance(centroids.row(nearest).data(), point, static_cast<int>(centroids.cols())))
        nearest = c;
    return nearest;
  };
  return {{"distance", distance(Contest::kDominance), apart, false},
          {"local_competition", distance(Contest::kFitness), apart, false},
          {"grid",
           [](int genes, int d) {
             return std::make_unique<GridArchive>(genes, GridCells{d, test_cells(d), 0, 1});
           },
           [cell](const float* a, const float* b, int d) {
             for (int i = 0; i < d; ++i)
               if (cell(a[i], test_cells(d)) != cell(b[i], test_cells(d))) return false;
             return true;
           },
           true},
          {"cvt", [](int genes, int d) { return make_cvt_archive(genes, test_centroids(d), 0, 1); },
           [centroid](const float* a, const float* b, int d) {
             return centroid(test_centroids(d), a) == centroid(test_centroids(d), b);
           },
           true}};
}

struct SelectorKind {
  std::string name;
  std::function<std::unique_ptr<Selector>()> make;  // for descriptors of size 2 in about [0, 1]^2
};
inline void PrintTo(const SelectorKind& s, std::ostream* out) { *out << s.name; }

inline constexpr int kTestNeighbours = 5;

inline std::vector<SelectorKind> all_selectors() {
  const auto scores = [] { return make_local_scores(2, kTestNeighbours, 0, 1); };
  return {{"uniform", [] { return std::make_unique<UniformSelector>(); }},
          {"curiosity", [] { return std::make_unique<CuriositySelector>(); }},
          {"fitness", [] { return std::make_unique<FitnessSelector>(); }},
          {"novelty", [scores] { return std::make_unique<NoveltySelector>(scores()); }},
          {"nslc", [scores] { return std::make_unique<NslcSelector>(scores()); }}};
}

}  // namespace hbr
