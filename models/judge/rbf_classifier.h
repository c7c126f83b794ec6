// Ten one-against-rest classifiers that share their Gaussian bumps: a regularised least-squares fit of each
// class's indicator.
//
// On HOG features of MNIST it is as good as support vector machines and trains fifty times as fast, in closed
// form. Far from everything it was shown it answers "none of the classes".
#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/core/parallel.h"
#include "pipeline/qd/elites.h"

namespace hbr::inline judge {

struct RbfClassifier {
  Rows centres;      // [bumps x d]
  Rows weights;      // [bumps x classes]
  double gamma = 0;  // a bump is exp(-gamma |x - centre|^2)

  // The margins [n x classes] of features [n x d]: about 1 for a member of the class, -1 for another;
  // positive means accepted.
  Rows margins(const Rows& features, Workers& workers) const;
};

// Fits to features [n x d] with labels 0 to classes - 1, the centres taken evenly from them (bumps <= n).
// `ridge` > 0 is the penalty on the squared weights.
RbfClassifier fit_rbf_classifier(const Rows& features, const std::vector<std::uint8_t>& labels, int classes,
                                 int bumps, double gamma, double ridge);

}  // namespace hbr::inline judge
