// Whole searches and evaluations against the same without anything that makes them fast.
#include <gtest/gtest.h>

#include "tests/support/evolved_layers.h"
#include "tests/support/naive_layers.h"

namespace hbr {
namespace {

template <class Parts>
Elites short_points(std::int64_t generations) {
  const PlanarArm arm(kLinks, kJointLimit);
  return evolved<Parts>(PointEvaluator(arm, kFrame, joint_costs()[0]), 8, kPointArchive, generations,
                        Seed(30));
}

TEST(WholeRun, LayerOneIsTheSameAsWithoutStructures) {
  const Elites fast = short_points<FastParts>(40), naive = short_points<NaiveParts>(40);
  EXPECT_GT(fast.size(), 1500);
  EXPECT_EQ(fast.id, naive.id);
  EXPECT_EQ(fast.parent, naive.parent);
  EXPECT_EQ(fast.solution, naive.solution);
  EXPECT_EQ(fast.measures, naive.measures);
}

// The medians stop at the same tolerance, each by its own way: a few times 1e-6 apart, a little more where
// they approach a sample.
template <class Fast, class Naive>
void agree(const Fast& fast, const Naive& naive, int genes, Eigen::Index n, int samples) {
  Batch a(static_cast<int>(n), genes, fast.descriptor_size()), b = a;
  Rng rng(Seed(31));
  a.genome = b.genome = Rows::NullaryExpr(n, genes, [&] { return rng.uniform(); });
  fast.evaluate(a, 0, n, Seed(32));
  naive.evaluate(b, 0, n, Seed(32));
  int same = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    EXPECT_LT((a.descriptor.row(i) - b.descriptor.row(i)).norm(), samples == 1 ? 1e-6 : 1e-4);
    EXPECT_NEAR(a.uncertainty[i], b.uncertainty[i], 2e-6);
    same += std::abs(a.fitness[i] - b.fitness[i]) < 1e-5f;
  }
  EXPECT_GE(same, n * 9 / 10);  // two samples as near to the median may change places
}

TEST(WholeRun, LinesAndArcsAreTheSameOneByOne) {
  const PlanarArm arm(kLinks, kJointLimit);
  const Elites point_elites = short_points<FastParts>(20);
  const Stack points = stack_of(arm, point_elites);
  const Elites line_elites = evolved<FastParts>(make_lines(lines_settings(3), {arm, &points})->evaluator(), 2,
                                                kLineArchive, 20, Seed(33));
  const Stack lines = stack_of(arm, point_elites, line_elites);
  const NaiveHierarchy hierarchy(point_elites, line_elites, arm, kFrame);
  const ArcController& controller = named(arc_controllers(), "lines", "controller");
  for (const int samples : {1, 10, 33}) {
    agree(make_lines(lines_settings(samples), {arm, &points})->evaluator(),
          NaiveLineEvaluator(hierarchy, samples), 2, 100, samples);
    agree(make_arcs(arcs_settings("lines", samples), {arm, &lines})->evaluator(),
          NaiveArcEvaluator(hierarchy, controller, samples),
          static_cast<int>(controller.genes(kFrame).size()), 100, samples);
  }
}

}  // namespace
}  // namespace hbr
