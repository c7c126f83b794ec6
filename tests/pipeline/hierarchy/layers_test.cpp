// Points, lines and arcs against a plain second execution.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "pipeline/hierarchy/arc_layer.h"
#include "pipeline/hierarchy/geometric_median.h"
#include "tests/pipeline/hierarchy/layers.h"

namespace hbr {
namespace {

TEST_F(Layers, PointsAreWhereTheArmIs) {
  const PointLayer points(point_elites, arm, kFrame);
  for (int i = 0; i < points.size(); ++i) {
    Pen p;
    arm.pens(1, points.joints(i), &p);
    EXPECT_LT((points.position(i) - p.position).norm(), 1e-6);
    const Eigen::Map<const Eigen::VectorXd> q(points.joints(i), 8);
    EXPECT_NEAR(points.variance(i), (q.array() - q.mean()).square().mean(), 1e-12);
    std::vector<double> squares;
    for (const double x : q) squares.push_back(x * x);
    std::sort(squares.begin(), squares.end());
    EXPECT_NEAR(few_joints(q.data(), 8), std::accumulate(squares.begin(), squares.begin() + 6, 0.0), 1e-12);
  }
}

TEST_F(Layers, LinesEndAtTheEliteNearestToWhatTheyAskFor) {
  const PointLayer points(point_elites, arm, kFrame);
  std::vector<std::int32_t> path;
  for (int i = 0; i < 500; ++i) {
    const int start = static_cast<int>(rng.below(400));
    const float genes[2] = {rng.uniform(), rng.uniform()};
    const Eigen::Vector2d d = decode_line(kFrame, genes);
    EXPECT_LE(d.norm(), kFrame.longest_line * (1 + 1e-12));
    ASSERT_EQ(line_end(points, start, d), plain_line_end(start, d));
    path.assign(1, start);
    line_path(points, start, d, 0.0128, path);
    EXPECT_EQ(path.back(), line_end(points, start, d));
    std::vector<std::int32_t> expected{start};
    int parts = 1;
    while (d.norm() / parts > 0.0128) ++parts;
    for (int k = 1; k <= parts; ++k) expected.push_back(plain_line_end(start, d * k / parts));
    expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
    EXPECT_EQ(path, expected);
  }
}

TEST_F(Layers, ALineIsDescribedByTheMedianOfItsExecutions) {
  const PointLayer points(point_elites, arm, kFrame);
  const LineEvaluator evaluator(points, kFrame, 25);
  Batch batch(30, 2, 2);
  batch.genome = Rows::NullaryExpr(30, 2, [&] { return rng.uniform(); });
  const Seed seed(25);
  evaluator.evaluate(batch, 0, 30, seed);
  for (int i = 0; i < 30; ++i) {
    Rng starts(seed.child(i));
    Samples<2> samples;
    samples.resize(25);
    for (int s = 0; s < 25; ++s) {
      const int start = static_cast<int>(starts.below(400));
      const Eigen::Vector2d v =
          pen(plain_line_end(start, decode_line(kFrame, batch.genome.row(i).data()))) - pen(start);
      samples.coordinate(0)[s] = static_cast<float>(v.x() / (2 * kFrame.longest_line) + 0.5);
      samples.coordinate(1)[s] = static_cast<float>(v.y() / (2 * kFrame.longest_line) + 0.5);
    }
    const Median<2> median = geometric_median<2>(samples);
    EXPECT_LT((batch.descriptor.row(i).transpose() - median.point).norm(), 1e-6);
    EXPECT_NEAR(batch.uncertainty[i], median.mean_distance, 1e-6);
    EXPECT_EQ(batch.fitness[i], 0);
  }
}

TEST_F(Layers, AReferenceLineIsDescribedByItsStartAndItsDisplacement) {
  const PointLayer points(point_elites, arm, kFrame);
  Batch batch(30, 2, 4);
  batch.genome = Rows::NullaryExpr(30, 2, [&] { return rng.uniform(); });
  LineFromStartEvaluator(points, kFrame).evaluate(batch, 0, 30, Seed(26));
  for (int i = 0; i < 30; ++i) {
    const Eigen::Vector4d d = batch.descriptor.row(i).transpose().cast<double>();
    const int start = plain_nearest(point_elites.measures, d.head<2>());
    const Eigen::Vector2d v =
        pen(plain_line_end(start, decode_line(kFrame, batch.genome.row(i).data()))) - pen(start);
    EXPECT_LT((kFrame.line(d.tail<2>()) - v).norm(), 1e-6);
    EXPECT_LT((kFrame.point(d.head<2>()) - pen(start)).norm(), 1e-6);
  }
}

TEST_F(Layers, AnArcIsFiveLinesThroughLayerTwo) {
  const PointLayer points(point_elites, arm, kFrame);
  const LineLayer lines(line_elites, kFrame);
  for (const char* name : {"lines", "turn"}) {
    const ArcController controller = arc_controller(name);
    const ArcEvaluator evaluator(points, lines, kFrame, controller, 7);
    for (int i = 0; i < 50; ++i) {
      std::vector<float> genome(controller.genes);
      for (float& g : genome) g = rng.uniform();
      Rng execution(Seed(27).child(i)), again(Seed(27).child(i));
      const ArcEvaluator::Outcome outcome = evaluator.execute(genome.data(), execution);

      Samples<3> descriptors;
      descriptors.resize(7);
      std::vector<double> fitness;
      for (int s = 0; s < 7; ++s) {
        int at = static_cast<int>(again.below(400));
        ArcPoints drawn{pen(at)};
        double variance = 0;
        for (int k = 0; k < 5; ++k) {
          at = plain_line_end(at, plain_request(controller.decode(kFrame, genome.data())[k]));
          drawn[k + 1] = pen(at);
          variance += points.variance(at) / 5;
        }
        const ArcShape shape = arc_shape(drawn);
        const Eigen::Vector3d d = arc_descriptor(kFrame, shape);
        for (int c = 0; c < 3; ++c) descriptors.coordinate(c)[s] = static_cast<float>(d[c]);
        fitness.push_back(-(irregularity(drawn) + variance));
      }
      const Median<3> median = geometric_median<3>(descriptors);
      EXPECT_LT((outcome.descriptor - median.point).norm(), 1e-6);
      EXPECT_NEAR(outcome.uncertainty, median.mean_distance, 1e-6);
      EXPECT_NEAR(outcome.fitness(), fitness[median.nearest], 1e-9);

      Batch batch(3, controller.genes, 3);
      batch.genome.row(2) = Eigen::RowVectorXf::Map(genome.data(), controller.genes);
      evaluator.evaluate(batch, 2, 3, Seed(28));
      Rng row(Seed(28).child(2));
      const ArcEvaluator::Outcome alone = evaluator.execute(genome.data(), row);
      EXPECT_EQ(batch.descriptor.row(2).transpose(), alone.descriptor);
      EXPECT_EQ(batch.uncertainty[2], alone.uncertainty);
      EXPECT_EQ(batch.fitness[2], static_cast<float>(alone.fitness()));
    }
  }
}

TEST_F(Layers, AnArcsWaypointsAreTheEndsOfItsLines) {
  const PointLayer points(point_elites, arm, kFrame);
  const LineLayer lines(line_elites, kFrame);
  const ArcController controller = arc_controller("lines");
  const ArcEvaluator once(points, lines, kFrame, controller, 1);
  for (int i = 0; i < 50; ++i) {
    float genome[10];
    for (float& g : genome) g = rng.uniform();
    const ArcLines wanted = controller.decode(kFrame, genome);
    const int start = static_cast<int>(Rng(Seed(30).child(i)).below(400));
    Rng execution(Seed(30).child(i));
    const ArcWaypoints waypoints = once.execute(genome, execution).waypoints;
    const ArcPoints positions = pen_positions(points, waypoints);
    int at = start;
    double cost = 0;
    EXPECT_EQ(waypoints[0], start);
    for (int k = 0; k < 5; ++k) {
      at = plain_line_end(at, plain_request(wanted[k]));
      EXPECT_EQ(waypoints[k + 1], at);
      EXPECT_LT((positions[k + 1] - pen(at)).norm(), 1e-9);
      cost += few_joints(points.joints(at), 8) / 5;
    }
    EXPECT_NEAR(mean_joint_cost(points, waypoints, few_joints), cost, 1e-12);
  }
}

TEST_F(Layers, TheTurnControllerAsksForARegularArc) {
  const float genes[3] = {0.3f, 0.6f, 0.55f};
  const ArcLines lines = arc_controller("turn").decode(kFrame, genes);
  ArcPoints ideal{Eigen::Vector2d::Zero()};
  for (int i = 0; i < 5; ++i) {
    EXPECT_NEAR(lines[i].norm(), 0.6f * kFrame.longest_line, 1e-9);
    ideal[i + 1] = ideal[i] + lines[i];
  }
  EXPECT_LT(irregularity(ideal), 1e-12);
  EXPECT_NEAR(std::atan2(lines[0].y(), lines[0].x()), (2 * 0.3f - 1) * std::numbers::pi, 1e-9);
  const double turn =
      std::atan2(lines[0].x() * lines[1].y() - lines[0].y() * lines[1].x(), lines[0].dot(lines[1]));
  EXPECT_NEAR(turn, (2 * 0.55f - 1) * std::numbers::pi, 1e-9);
}

TEST_F(Layers, AFlatArcStartsAtTheStraightArm) {
  const FlatArcEvaluator evaluator(arm, kFrame);
  Batch batch(20, evaluator.genes(), 3);
  batch.genome = Rows::NullaryExpr(20, 40, [&] { return rng.uniform(); });
  evaluator.evaluate(batch, 0, 20, Seed(0));
  for (int i = 0; i < 20; ++i) {
    ArcPoints drawn{Eigen::Vector2d(0.5815, 0)};
    double variance = 0;
    for (int w = 0; w < 5; ++w) {
      Eigen::VectorXd q =
          (batch.genome.row(i).segment(8 * w, 8).transpose().cast<double>().array() - 0.5) * std::numbers::pi;
      Pen p;
      arm.pens(1, q.data(), &p);
      drawn[w + 1] = p.position;
      variance += (q.array() - q.mean()).square().mean() / 5;
    }
    const ArcShape shape = arc_shape(drawn);
    EXPECT_LT((batch.descriptor.row(i).transpose().cast<double>() - arc_descriptor(kFrame, shape)).norm(),
              1e-6);
    EXPECT_NEAR(batch.fitness[i], -(irregularity(drawn) + variance), 1e-4);
  }
}

}  // namespace
}  // namespace hbr
