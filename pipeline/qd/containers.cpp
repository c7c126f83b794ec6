#include "pipeline/qd/containers.h"

#include "pipeline/qd/cvt_archive.h"
#include "pipeline/qd/distance_archive.h"
#include "pipeline/qd/grid_archive.h"
#include "pipeline/qd/named.h"

namespace hbr::inline qd {
namespace {

template <Contest contest>
Container distance(int genes, int size, const ContainerSettings& s, Seed) {
  return {make_distance_archive(
      genes, size,
      {static_cast<float>(s.spacing), static_cast<float>(s.epsilon), s.neighbours, s.low, s.high, contest})};
}

Container grid(int genes, int size, const ContainerSettings& s, Seed) {
  return {std::make_unique<GridArchive>(genes, GridCells{size, s.grid_cells, s.low, s.high})};
}

Container cvt(int genes, int size, const ContainerSettings& s, Seed seed) {
  Rows centroids = cvt_centroids(s.cvt_cells, size, s.low, s.high, seed.child("centroids"));
  return {make_cvt_archive(genes, centroids, s.low, s.high), centroids};
}

constexpr ContainerKind kContainers[] = {
    {"distance", "the unstructured archive", false, distance<Contest::kDominance>},
    {"local_competition", "the same, where the fitter of two near ones stays", false,
     distance<Contest::kFitness>},
    {"grid", "MAP-Elites", false, grid},
    {"cvt", "CVT-MAP-Elites", true, cvt},
};

}  // namespace

std::span<const ContainerKind> container_kinds() { return kContainers; }
const ContainerKind& container_kind(const std::string& name) { return named(kContainers, name, "container"); }

}  // namespace hbr::inline qd
