#include "models/arm/planar_arm.h"

#include <cmath>

namespace hbr {

PlanarArm::PlanarArm(const std::vector<double>& links, double limit)
    : links_(links),
      lower_(Eigen::VectorXd::Constant(static_cast<Eigen::Index>(links.size()), -limit)),
      upper_(-lower_) {}

void PlanarArm::pens(Eigen::Index n, const double* joints, Pen* pens) const {
  for (Eigen::Index i = 0; i < n; ++i) {
    double angle = 0, x = 0, y = 0;
    for (const double link : links_) {
      angle += *joints++;
      x += link * std::cos(angle);
      y += link * std::sin(angle);
    }
    pens[i] = {{x, y}, 0};
  }
}

}  // namespace hbr
