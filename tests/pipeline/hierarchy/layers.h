// Small layers of the arm, and a plain second execution that asks every elite for its distance.
#pragma once

#include <gtest/gtest.h>

#include <numbers>

#include "models/arm/planar_arm.h"
#include "tests/support/stacks.h"

namespace hbr {

inline int plain_nearest(const Rows& measures, const Eigen::VectorXd& wanted) {
  int best = 0;
  const Eigen::VectorXf w = wanted.cast<float>();
  const auto distance = [&](int i) {
    float sum = 0;
    for (Eigen::Index d = 0; d < w.size(); ++d) sum += (measures(i, d) - w[d]) * (measures(i, d) - w[d]);
    return sum;
  };
  for (int i = 1; i < measures.rows(); ++i)
    if (distance(i) < distance(best)) best = i;
  return best;
}

inline Elites some_elites(int n, int genes, int d, Rng& rng) {
  Elites e;
  e.solution = Rows::NullaryExpr(n, genes, [&] { return rng.uniform(); });
  e.measures = Rows::NullaryExpr(n, d, [&] { return rng.uniform(); });
  return e;
}

class Layers : public testing::Test {
 protected:
  Layers() {
    Batch batch(400, 8, 2);
    batch.genome = Rows::NullaryExpr(400, 8, [&] { return rng.uniform(); });
    PointEvaluator(arm, kFrame, joint_costs()[0]).evaluate(batch, 0, 400, Seed(0));
    point_elites.solution = batch.genome;
    point_elites.measures = batch.descriptor;
    line_elites = some_elites(200, 2, 2, rng);
    arc_elites = some_elites(300, 3, 3, rng);
  }

  Eigen::Vector2d pen(int elite) const {
    return kFrame.point(point_elites.measures.row(elite).transpose().cast<double>());
  }
  int plain_line_end(int start, const Eigen::Vector2d& displacement) const {
    const Eigen::Vector2f step = (displacement / (2 * kFrame.half_side)).cast<float>();
    return plain_nearest(point_elites.measures,
                         (point_elites.measures.row(start).transpose() + step).cast<double>());
  }
  Eigen::Vector2d plain_request(const Eigen::Vector2d& wanted) const {
    const int i = plain_nearest(line_elites.measures, kFrame.line_descriptor(wanted));
    Eigen::Vector2d d((line_elites.solution(i, 0) - 0.5) * 2 * kFrame.longest_line,
                      (line_elites.solution(i, 1) - 0.5) * 2 * kFrame.longest_line);
    if (d.norm() > kFrame.longest_line) d *= kFrame.longest_line / d.norm();
    return d;
  }

  Stack points() const { return stack_of(arm, point_elites); }
  Stack lines() const { return stack_of(arm, point_elites, line_elites); }
  Stack arcs() const { return stack_of(arm, point_elites, line_elites, arc_elites); }

  Rng rng{Seed(24)};
  PlanarArm arm{{.0875, .078, .072, .072, .071, .068, .068, .065}, std::numbers::pi / 2};
  Elites point_elites, line_elites, arc_elites;
};

}  // namespace hbr
