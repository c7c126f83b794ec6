// The geometric median: the point with the least sum of distances to a set of points. It makes a descriptor
// stochastic: the typical outcome over random initial conditions (paper, section 3.1).
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace hbr::inline hierarchy {

// n points in D dimensions, a coordinate after the other, each filled up to whole groups of lanes. Sums run
// over the lanes first and over a group's lanes last, whatever the width of the machine's vectors: the same
// bits everywhere.
template <int D>
class Samples {
 public:
  static constexpr int kLanes = 16;

  void resize(int n);
  int size() const { return size_; }
  int groups() const { return groups_; }
  float* coordinate(int d) { return values_[d].data(); }
  const float* coordinate(int d) const { return values_[d].data(); }
  // 1 for a sample, 0 for what fills up.
  const float* present() const { return present_.data(); }
  Eigen::Matrix<float, D, 1> sample(int i) const {
    Eigen::Matrix<float, D, 1> point;
    for (int d = 0; d < D; ++d) point[d] = values_[d][i];
    return point;
  }

 private:
  int size_ = 0, groups_ = 0;
  std::array<std::vector<float>, D> values_;
  std::vector<float> present_;
};

template <int D>
struct Median {
  Eigen::Matrix<float, D, 1> point;
  float mean_distance;  // from the samples to the median: the descriptor's uncertainty
  int nearest;          // index of the sample nearest to the median, the lower one of two as near
};

// At least one sample, all finite and of the order of 1. Weiszfeld's iteration with the step of Vardi and
// Zhang (2000) at a sample point, until it moves by less than 1e-6.
template <int D>
Median<D> geometric_median(const Samples<D>& samples);

}  // namespace hbr::inline hierarchy
