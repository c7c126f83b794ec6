// An arm of three joints learns to reach points, in twenty lines. Fails where it has not learnt it.
#include <cstdio>

#include "models/arm/planar_arm.h"
#include "pipeline/hierarchy/layers/points.h"
#include "pipeline/hierarchy/stack.h"
#include "pipeline/qd/distance_archive.h"
#include "pipeline/qd/search.h"

int main() {
  const hbr::PlanarArm arm({0.3, 0.2, 0.1}, 3);
  auto points = hbr::make_points({0.6, "joint_variance"}, {arm});
  const auto archive = hbr::make_distance_archive(3, 2, {0.05f, 0.1f, 15, 0, 1});
  const hbr::PolynomialMutation mutation(3, {10, 0.1f});
  hbr::CuriositySelector selector;
  hbr::Search search(*archive, selector, mutation, points->evaluator(), {200, 100, 50}, hbr::Seed(1));
  hbr::Workers workers(2);
  while (!search.done()) search.step(workers);

  hbr::Stack stack;
  stack.add(std::move(points), archive->store().in_id_order());
  const Eigen::Vector2d place(0.2, 0.3);
  const Eigen::Vector2d reached = stack.points().position(stack.points().nearest(place));
  const double distance = (reached - place).norm(), most = 0.06;  // m
  std::printf("%d points; the nearest is %.3f m from (0.2, 0.3), at most %g expected\n", archive->size(),
              distance, most);
  return distance <= most ? 0 : 1;
}
