#include "pipeline/qd/cvt_archive.h"

#include <cmath>
#include <vector>

#include "pipeline/core/check.h"
#include "pipeline/qd/cell_archive.h"
#include "pipeline/qd/dimension.h"
#include "pipeline/qd/neighbour_grid.h"

namespace hbr::inline qd {
namespace {

constexpr int kSamplesPerCell = 25;
constexpr int kRounds = 30;  // of Lloyd's algorithm; from then on a round moves a centre by little

template <int D>
class NearestCentroid {
 public:
  NearestCentroid(Rows centroids, float low, float high)
      : centroids_(std::move(centroids)), grid_(low, high, cell_size(low, high)) {
    for (Slot c = 0; c < centroids_.rows(); ++c) grid_.insert(c, point(c));
  }

  Slot operator()(const float* query) const {
    typename NeighbourGrid<D>::Near near;
    grid_.nearest(query, 1, kNoSlot, &near);
    return near.slot;
  }

 private:
  const float* point(Slot c) const { return centroids_.row(c).data(); }
  // About one centroid in a cell of the grid.
  float cell_size(float low, float high) const {
    constexpr float dims = NeighbourGrid<D>::kGridDims;
    return (high - low) / std::pow(static_cast<float>(centroids_.rows()), 1 / dims);
  }

  Rows centroids_;
  NeighbourGrid<D> grid_;
};

// Lloyd's algorithm; a centre that no sample is nearest to stays.
template <int D>
Rows k_means(const Rows& samples, Rows centroids, float low, float high) {
  std::vector<Slot> nearest(samples.rows(), kNoSlot);
  for (int round = 0; round < kRounds; ++round) {
    const NearestCentroid<D> nearest_centroid(centroids, low, high);
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(centroids.rows(), D);
    std::vector<std::int32_t> count(centroids.rows(), 0);
    bool changed = false;
    for (Eigen::Index i = 0; i < samples.rows(); ++i) {
      const Slot c = nearest_centroid(samples.row(i).data());
      changed |= nearest[i] != c;
      nearest[i] = c;
      sum.row(c) += samples.row(i).cast<double>();
      ++count[c];
    }
    if (!changed) break;
    for (Eigen::Index c = 0; c < centroids.rows(); ++c)
      if (count[c]) centroids.row(c) = (sum.row(c) / count[c]).template cast<float>();
  }
  return centroids;
}

template <int D>
class CvtArchive final : public CellArchive {
 public:
  CvtArchive(int genes, const Rows& centroids, float low, float high)
      : CellArchive(genes, D, centroids.rows()), nearest_(centroids, low, high) {}

 private:
  std::size_t cell_of(const float* descriptor) const override {
    return static_cast<std::size_t>(nearest_(descriptor));
  }
  NearestCentroid<D> nearest_;
};

}  // namespace

Rows cvt_centroids(int cells, int descriptor_size, float low, float high, Seed seed) {
  HBR_CHECK(cells > 0 && high > low, "{} cells over [{}, {}]", cells, low, high);
  Rng rng(seed);
  Rows samples(static_cast<Eigen::Index>(kSamplesPerCell) * cells, descriptor_size);
  for (float& x : samples.reshaped<Eigen::RowMajor>()) x = rng.uniform(low, high);
  return with_dimension(descriptor_size, [&](auto d) {
    return k_means<decltype(d)::value>(samples, samples.topRows(cells), low, high);
  });
}

std::unique_ptr<Repertoire> make_cvt_archive(int genes, const Rows& centroids, float low, float high) {
  HBR_CHECK(centroids.rows() > 0 && high > low, "{} centroids over [{}, {}]", centroids.rows(), low, high);
  return with_dimension(static_cast<int>(centroids.cols()), [&](auto d) -> std::unique_ptr<Repertoire> {
    return std::make_unique<CvtArchive<decltype(d)::value>>(genes, centroids, low, high);
  });
}

}  // namespace hbr::inline qd
