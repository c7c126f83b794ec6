// The planar arm (paper, section 4.1): revolute joints in a row, the base at the origin, the pen at the tip.
#pragma once

#include <vector>

#include "pipeline/hierarchy/robot.h"

namespace hbr::inline arm {

class PlanarArm final : public Robot {
 public:
  // links: lengths in metres, base first; every joint turns in [-limit, limit] rad from the link before it, 0
  // is straight along +x. Joints of up to 1e9 rad have a meaning, within 1e-16 x their size in rad.
  PlanarArm(const std::vector<double>& links, double limit);

  std::string name() const override { return "arm"; }
  const Eigen::VectorXd& lower() const override { return lower_; }
  const Eigen::VectorXd& upper() const override { return upper_; }
  void pens(Eigen::Index n, const double* joints, Pen* pens) const override;
  const std::vector<double>& links() const { return links_; }

 private:
  std::vector<double> links_;
  Eigen::VectorXd lower_, upper_;
};

}  // namespace hbr::inline arm
