// The geometric median: the point with the least sum of distances to a set of points. It makes a descriptor
// stochastic: the typical outcome over random initial conditions (paper, section 3.1).
#pragma once

#include <Eigen/Core>

namespace hbr {

template <int D>
struct Median {
  Eigen::Matrix<double, D, 1> point;
  double mean_distance;  // from the samples to the median: the descriptor's uncertainty
  int nearest;           // index of the sample nearest to the median, the lower one of two as near
};

// points [n x D], n > 0, finite. Weiszfeld's iteration with the step of Vardi and Zhang (2000) at a sample
// point, until it moves by less than 1e-7.
template <int D>
Median<D> geometric_median(const double* points, int n);

}  // namespace hbr
